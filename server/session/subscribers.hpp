// The monitor sessions that follow a cell, and the schedule for serving them: on a grid of 1/60 s,
// at the points where a subscription is due, only while a subscribed channel may have changed. A
// few sessions are served at a time, so that a robot line never waits for a thousand of them.
// Without subscriptions, a moving cell is advanced once a second, for the log and the rings. At
// rest no timer runs.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "cell/cell.hpp"
#include "cell/frames.hpp"
#include "server/net/asio.hpp"
#include "server/net/wall_clock.hpp"
#include "server/session/session.hpp"

namespace xr3 {

class SubscriberHub {
 public:
  /// Sessions served in one turn of the loop.
  static constexpr std::size_t kFairShare = 64;

  /// The references must outlive it. `run_lines` is called after every few sessions, for work that
  /// must not wait for all of them.
  SubscriberHub(asio::io_context& io, Cell& cell, FrameCache& frames,
                std::function<void()> run_lines)
      : io_(io), timer_(io), cell_(cell), frames_(frames), run_lines_(std::move(run_lines)) {}
  SubscriberHub(const SubscriberHub&) = delete;
  SubscriberHub& operator=(const SubscriberHub&) = delete;
  /// Removes all sessions.
  ~SubscriberHub();

  /// Adds a session that follows a channel of the cell. No effect if it is there.
  void add(MonitorSession& session);
  /// No effect unless it was added.
  void remove(MonitorSession& session);

  /// The cell or a subscription has changed: serves all sessions at the next point of the grid.
  void changed();
  void stop();

  /// The current point of the grid.
  static monitor::FrameNumber wall_frame();
  /// The point of the grid at which frames are made: during a round that of the round, else the
  /// current one.
  monitor::FrameNumber now() const { return is_serving_ ? frame_ : wall_frame(); }

  const std::vector<MonitorSession*>& sessions() const { return sessions_; }

 private:
  enum class Wake : std::uint8_t { kNone, kSecond, kFrame };

  void wake_soon();
  void arm(Wake wake, WallNs when);
  void arm_second();
  void arm_at(monitor::FrameNumber frame);
  void arm_frame();
  void on_timer();
  void begin_round();
  void serve_some();
  void serve(MonitorSession& session);
  void end_round();
  bool has_followers() const;

  asio::io_context& io_;
  asio::steady_timer timer_;
  Cell& cell_;
  FrameCache& frames_;
  std::function<void()> run_lines_;
  std::vector<MonitorSession*> sessions_;
  Wake armed_ = Wake::kNone;
  monitor::FrameNumber armed_frame_ = 0;  ///< if armed_ is kFrame
  bool is_stopped_ = false;
  bool is_serving_ = false;          ///< during a round
  bool has_acted_ = false;           ///< changed() was called during the round
  bool is_settled_ = true;           ///< no session of this round waits for a later frame
  monitor::FrameNumber due_ = 0;     ///< the earliest due frame of this round's sessions
  std::size_t next_ = 0;             ///< index of the round's next session
  monitor::FrameNumber frame_ = -1;  ///< point of the last round
};

}  // namespace xr3
