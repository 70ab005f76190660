// The sessions of all serial lines, and their turns: no line waits for one that takes much time.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "cell/cell.hpp"
#include "server/lines/session.hpp"
#include "server/lines/source.hpp"
#include "server/lines/turn_queue.hpp"
#include "server/lines/watch.hpp"
#include "server/net/asio.hpp"
#include "server/net/line_transports.hpp"
#include "server/net/memory_limit.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

class LineSessions final : public LineTransports {
 public:
  /// `acted` is called after each input, and when a line has opened or closed.
  LineSessions(asio::io_context& io, Cell& cell, std::function<void()> acted);

  /// read_arrived() asks this source for new clients, too. It must outlive its sessions.
  void add(LineSource& source) { sources_.push_back(&source); }

  /// Opens a line, which has its turns from now on. nullopt if the system refuses to watch the
  /// stream; the line is closed then. `place` may be null.
  std::optional<LineId> open(LineSource& source, std::unique_ptr<LineStream> stream,
                             const LineOpened& opened,
                             std::unique_ptr<PeerCounts::Place> place = nullptr);

  /// From now on the lines count towards a limit of memory, which must outlive the sessions.
  void limit_memory(MemoryLimit& limit) { context_.memory = &limit; }
  /// The most bytes that one line holds.
  std::size_t most_held() const;
  /// Closes the line that holds the most bytes. Precondition: most_held() > 0.
  void close_greediest();

  void read_arrived() override;
  void run_turns() override;
  /// Runs a few turns if the last ones are kTurnsEvery ago. The event loop calls this after every
  /// handler, so that a line waits for one handler at most, however many are ready.
  void run_due_turns();
  static constexpr WallNs kTurnsEvery = 200'000;
  asio::awaitable<bool> wait_for_bytes(LineId line, std::uint64_t bytes_in,
                                       std::chrono::milliseconds within) override;
  bool disconnect(LineId line) override;
  PortCounters counters() const override;

  /// Gives a line a turn, if it is open: it can go on for another reason than news of its stream.
  void wake(LineId line);

  /// Looks for streams that have ended without notice so far.
  void take_news();

  /// Sessions send their outboxes and end. Those that have not begun to do so at the deadline are
  /// closed at once. The sources must open no further lines.
  void close(WallNs deadline = kNever);
  bool is_empty() const { return sessions_.empty(); }
  /// Closes the remaining sessions at once.
  void abort();
  /// Destroys the remaining sessions without a report, before the objects that they refer to.
  void drop() { sessions_.clear(); }

 private:
  using Sessions = std::map<LineId, std::shared_ptr<LineSession>>;

  asio::awaitable<void> run();
  void run_lightest(WallNs time);
  void run_turn(LineId line);
  void schedule_turns();
  void end(LineId line, LineCloseReason reason);
  void notify(LineId line);
  Sessions sessions() const { return sessions_; }
  std::shared_ptr<LineSession> greediest() const;
  void accept_arrived();
  void read_arrived_on(LineId line);
  void read_to_end(LineId line);

  asio::io_context& io_;
  Cell& cell_;
  std::function<void()> acted_;
  std::array<char, 64 * 1024> scratch_{};
  LineSessionContext context_;
  LineWatch watch_;
  bool is_watching_ = false;
  TurnQueue turns_;
  bool is_again_ = false;  ///< the next turns are scheduled
  WallNs next_turns_ = 0;  ///< earliest time of the next run_due_turns()
  /// By line; cancelled when its bytes have acted, or it has ended.
  std::multimap<LineId, asio::steady_timer*> waiting_;
  std::vector<LineSource*> sources_;
  Sessions sessions_;
  bool is_closing_ = false;
};

}  // namespace xr3
