// The TCP port of the serial lines: accepts connections up to the limit and keeps their sessions.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "cell/cell.hpp"
#include "server/net/asio.hpp"
#include "server/net/listener.hpp"
#include "server/robot_port/line_watch.hpp"
#include "server/robot_port/session.hpp"

namespace xr3 {

/// How far the server's own question down a line has come (`RobotProbe`).
enum class ProbeFate : std::uint8_t {
  kUnseen,    ///< its connection has not been accepted
  kRefused,   ///< every line was taken
  kAccepted,  ///< its line is open
  kTaken,     ///< its byte has gone through the parser
  kIgnored,   ///< so it has, but the controller is disabled and answers nothing
};

class RobotPort {
 public:
  /// `max_lines`: connections beyond are closed without a byte. `acted` is called after each input and each end.
  RobotPort(asio::io_context& io, Cell& cell, std::size_t max_lines, std::function<void()> acted);
  std::size_t max_lines() const { return max_lines_; }

  /// Binds; afterwards endpoint() is known and connections are accepted. Returns what went wrong.
  ErrorCode listen(const tcp::endpoint& endpoint);
  tcp::endpoint endpoint() const { return listener_.endpoint(); }

  /// Every byte that has already arrived on any line, also on one that has not been accepted yet,
  /// acts now, as far as the line's replies go out. `step` and `run_until` call it first, so that no
  /// byte is overtaken.
  void read_arrived();

  /// A turn for each line at which something has happened, and one for a line that had more to do than a
  /// turn holds: cheap enough to be taken between two writes to viewers, so that a line never waits
  /// behind a thousand of them, and no line behind many that flood.
  void run_turns();

  /// Waits until a line has received so many bytes in all. False: it did not within the time, it has
  /// closed without them, or the port is closing.
  asio::awaitable<bool> wait_for_bytes(LineId line, std::uint64_t bytes_in,
                                       std::chrono::milliseconds within);

  /// The next connection from there is the server's own: it becomes kProbeLine, under the same limit as
  /// other lines, but does not count as one of them.
  void expect_probe(const tcp::endpoint& from);
  /// None is: somebody else may have that endpoint from now on.
  void forget_probe() { probe_from_.reset(); }
  ProbeFate probe_fate() const { return probe_fate_; }

  /// Closes the connection of a line. False: none of this port's is it.
  bool disconnect(LineId line);

  /// Takes no further connection; sessions hand out what is in their outboxes and end.
  void close();
  bool is_empty() const { return sessions_.empty(); }
  /// Ends what close() left over.
  void abort();

 private:
  using Sessions = std::map<LineId, std::shared_ptr<RobotSession>>;

  void open(tcp::socket socket);
  bool is_probe(const tcp::socket& socket);
  bool is_full() const;
  void refuse(bool is_probe);
  void end_probe();
  asio::awaitable<void> run();
  void take_news();
  void take_unfinished_turn();
  void run_turn(LineId line);
  void schedule_turns();
  void end(LineId line);
  Sessions sessions() const { return sessions_; }

  void notify();

  asio::io_context& io_;
  Cell& cell_;
  std::size_t max_lines_;
  std::function<void()> acted_;
  std::array<char, 64 * 1024> scratch_{};
  RobotSessionContext context_;
  RobotSessionContext probe_context_;
  Listener listener_;
  LineWatch watch_;
  bool is_watching_ = false;
  bool has_logged_full_ = false;
  std::optional<tcp::endpoint> probe_from_;  ///< has not been accepted yet
  ProbeFate probe_fate_ = ProbeFate::kUnseen;
  std::set<LineId> unfinished_;            ///< had more to do than a turn holds
  LineId last_unfinished_ = 0;             ///< of them, the one that had its turn last
  bool is_again_ = false;                  ///< their next turns are on their way
  std::set<asio::steady_timer*> waiting_;  ///< cancelled when bytes have acted
  Sessions sessions_;
  bool is_closing_ = false;
};

}  // namespace xr3
