// The turns of the serial lines of all cells. One watch and one buffer serve them all.
//
// The flow through the folder: a source (source.hpp: the robot port or the pseudo-terminals) gives
// LineSessions (sessions.hpp) a stream (stream.hpp), which opens a line of the cell and a
// LineSession (session.hpp), and adds it here. LineWatch (watch.hpp) reports streams with events.
// Such a session waits in the queue `ready`, one that has used up its turn in `busy`; the queues
// have turns alternately, so that an inquiry waits for at most one turn of a line that floods, and
// a flood gets its turns beside a thousand inquiries. A turn reads at most 256 bytes from the
// stream (4,096 of a new line), or works for 150 us: the cell executes them, and the replies in the
// line's outbox are written. The event loop calls run_turns() when the watch has events, and
// run_due_turns() after each handler. Before a call that moves time, ArrivedBytes (arrived.hpp)
// reads what had arrived. DueTimer and SilenceTimer advance the cell when no input does.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <unordered_map>

#include "server/lines/session.hpp"
#include "server/lines/watch.hpp"
#include "server/net/asio.hpp"
#include "server/net/exclusive.hpp"
#include "server/net/memory_limit.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

class LineTurns {
 public:
  /// Throws boost::system::system_error if no descriptor is left.
  explicit LineTurns(asio::io_context& io) : io_(io), watch_(io) {}
  LineTurns(const LineTurns&) = delete;
  LineTurns& operator=(const LineTurns&) = delete;

  asio::io_context& io() { return io_; }
  /// A buffer for one read, shared by all sessions.
  std::span<char> scratch() { return scratch_; }

  /// Gives the session turns until remove(). Returns its number, which no other session has now, or
  /// nullopt if the system refuses to watch its stream.
  std::optional<SessionNumber> add(std::shared_ptr<LineSession> session);
  void remove(SessionNumber number);

  /// Counts the lines towards a limit of memory, which must outlive the sessions.
  void limit_memory(MemoryLimit& limit) { memory_ = &limit; }
  /// nullptr if there is none.
  MemoryLimit* memory() const { return memory_; }
  /// The most bytes that one line holds.
  std::size_t most_held() const;
  /// Closes the line that holds the most bytes. Precondition: most_held() > 0.
  void close_greediest();

  /// Runs turns until no line waits for one, or other ports must have theirs. It is cheap enough to
  /// be called between writes to monitor sessions.
  void run_turns();
  /// Runs a few turns if the last ones are kTurnsEvery ago. The event loop calls this after every
  /// handler, so that a line waits for one handler at most, however many are ready.
  void run_due_turns();
  static constexpr WallNs kTurnsEvery = 200'000;

  /// Runs one turn of a session now. Returns kBlocked if it is closed.
  LineSession::Turn run_turn(SessionNumber number);
  /// Gives a session a turn soon, after all handlers that are ready now.
  void wake(SessionNumber number);
  /// Polls for lines with events, among them streams that have ended, and gives each a turn now.
  void run_events();

  /// LineTransports::pause(), of all cells together.
  asio::awaitable<void> pause();

  /// Stops to watch when the last session has ended, so that nothing keeps the event loop running.
  void close();
  bool is_empty() const { return sessions_.empty(); }
  bool is_watching() const { return watch_.is_open(); }

 private:
  struct TurnEntry {
    std::shared_ptr<LineSession> session;
    bool is_queued = false;
  };
  using Queue = std::deque<SessionNumber>;  ///< numbers of closed sessions have no effect

  asio::awaitable<void> run();
  void run_for(WallNs time);
  void queue_events();
  void add_to(Queue& queue, SessionNumber number);
  Queue& next_queue();
  SessionNumber pop_front(Queue& queue);
  bool has_waiting() const { return !ready_.empty() || !busy_.empty(); }
  void schedule();
  std::shared_ptr<LineSession> greediest() const;

  asio::io_context& io_;
  std::array<char, 64 * 1024> scratch_{};
  LineWatch watch_;
  bool is_watching_ = false;
  std::unordered_map<SessionNumber, TurnEntry> sessions_;
  SessionNumber last_ = 0;
  Queue ready_;
  Queue busy_;
  bool is_busy_next_ = false;
  bool is_scheduled_ = false;
  WallNs next_turns_ = 0;  ///< earliest time of the next run_due_turns()
  MemoryLimit* memory_ = nullptr;
  Exclusive pausing_{io_};
  bool is_closing_ = false;
};

}  // namespace xr3
