// The turns of the serial lines of all cells: no line waits for one that takes much time. One watch
// and one buffer serve them all.
#pragma once

#include <array>
#include <boost/container/flat_map.hpp>
#include <cstdint>
#include <memory>
#include <span>

#include "server/lines/session.hpp"
#include "server/lines/turn_peers.hpp"
#include "server/lines/turn_queue.hpp"
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
  /// TurnPeers::at().
  std::shared_ptr<TurnQueue::Peer> peer(const asio::ip::address* address) {
    return peers_.at(address);
  }
  /// A buffer for one read, shared by all sessions.
  std::span<char> scratch() { return scratch_; }

  /// The session has its turns from now on, until remove(). Returns its number, which no other
  /// session has now, or nullopt if the system refuses to watch its stream.
  std::optional<SessionNumber> add(std::shared_ptr<LineSession> session);
  void remove(SessionNumber number);

  /// From now on the lines count towards a limit of memory, which must outlive the sessions.
  void limit_memory(MemoryLimit& limit) { memory_ = &limit; }
  /// nullptr: none.
  MemoryLimit* memory() const { return memory_; }
  /// The most bytes that one line holds.
  std::size_t most_held() const;
  /// Closes the line that holds the most bytes. Precondition: most_held() > 0.
  void close_greediest();

  /// Runs a turn for each line with news, and one turn for one of the lines with unfinished work.
  /// It is cheap enough to be called between writes to monitor sessions, so that a line never waits
  /// for a thousand sessions, nor for many flooding lines.
  void run_turns();
  /// Runs a few turns if the last ones are kTurnsEvery ago. The event loop calls this after every
  /// handler, so that a line waits for one handler at most, however many are ready.
  void run_due_turns();
  static constexpr WallNs kTurnsEvery = 200'000;

  /// Gives a session a turn soon, after all handlers that are ready now.
  void wake(SessionNumber number);

  /// LineTransports::pause(), of all cells together.
  asio::awaitable<void> pause();

  /// Looks for lines with news, among them streams that have ended. They have their turns now or
  /// soon.
  void take_news();

  /// Stops to watch when the last session has ended, so that nothing keeps the event loop running.
  void close();
  bool is_empty() const { return sessions_.empty(); }

 private:
  asio::awaitable<void> run();
  void run_lightest(WallNs time);
  std::size_t run_news(WallNs& now, WallNs end);
  void run_turn(SessionNumber number, WallNs now);
  void run_turn(SessionNumber number, std::shared_ptr<LineSession> session, WallNs now);
  void schedule();
  std::shared_ptr<LineSession> greediest() const;

  asio::io_context& io_;
  std::array<char, 64 * 1024> scratch_{};
  LineWatch watch_;
  bool is_watching_ = false;
  TurnPeers peers_;
  TurnQueue queue_;
  bool is_again_ = false;  ///< the next turns are scheduled
  WallNs next_turns_ = 0;  ///< earliest time of the next run_due_turns()
  SessionNumber last_ = 0;
  boost::container::flat_map<SessionNumber, std::shared_ptr<LineSession>> sessions_;
  MemoryLimit* memory_ = nullptr;
  Exclusive pausing_{io_};
  bool is_closing_ = false;
};

}  // namespace xr3
