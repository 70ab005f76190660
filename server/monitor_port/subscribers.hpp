// Everybody who watches a cell, and when they are served: on a grid of 1/60 s, at the points where
// somebody is due, only while something that somebody follows may have changed, and a few of them at a time, so that a robot line never waits
// behind a thousand sessions. Without followers a moving cell is brought up to date once a second, for
// the log and the rings. At rest nothing wakes.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "cell/cell.hpp"
#include "cell/frames.hpp"
#include "server/monitor_port/session.hpp"
#include "server/net/asio.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

class SubscriberHub {
 public:
  /// Sessions served in one turn of the loop.
  static constexpr std::size_t kFairShare = 64;

  /// All of them outlive it. `between` is called between two sessions: what must not wait for all.
  SubscriberHub(asio::io_context& io, Cell& cell, FrameCache& frames, std::function<void()> between)
      : io_(io), timer_(io), cell_(cell), frames_(frames), between_(std::move(between)) {}

  void add(MonitorSession& session) { sessions_.push_back(&session); }
  void remove(MonitorSession& session);

  /// Something has acted on the cell, or a session follows something else than before: everybody is
  /// served at the next point of the grid.
  void acted();
  void stop();

  /// The point of the grid at which we are; that of the round while one is under way.
  monitor::FrameNumber now() const { return is_serving_ ? frame_ : wall_frame(); }

  std::size_t size() const { return sessions_.size(); }

  /// What sessions were given since the server started, by monitor::Channel.
  using AllChannelStats = std::array<monitor::ChannelStats, monitor::kChannels>;
  AllChannelStats channel_stats() const;

 private:
  enum class Wake : std::uint8_t { kNone, kSecond, kFrame };

  static monitor::FrameNumber wall_frame();
  void wake_soon();
  void arm(Wake wake, WallNs when);
  void arm_second();
  void arm_at(monitor::FrameNumber frame);
  void arm_frame();
  void beat();
  void begin_round();
  void serve_some();
  void prefetch() const;
  void serve(MonitorSession& session);
  bool look(monitor::FrameSubscription& subscription);
  void end_round();
  bool has_followers() const;

  asio::io_context& io_;
  asio::steady_timer timer_;
  Cell& cell_;
  FrameCache& frames_;
  std::function<void()> between_;
  std::vector<MonitorSession*> sessions_;
  Wake armed_ = Wake::kNone;
  monitor::FrameNumber armed_frame_ = 0;  ///< where it is kFrame
  bool is_stopped_ = false;
  bool is_serving_ = false;          ///< a round is under way
  bool has_acted_ = false;           ///< meanwhile something has acted
  bool is_settled_ = true;           ///< nobody of this round waits for a later frame
  monitor::FrameNumber due_ = 0;     ///< when the first of this round wants to look again
  std::size_t next_ = 0;             ///< session of the round that comes next
  monitor::FrameNumber frame_ = -1;  ///< of the last round
  AllChannelStats gone_{};           ///< of sessions that have left
};

}  // namespace xr3
