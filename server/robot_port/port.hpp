// The TCP port of the serial lines: accepts connections up to the limit and owns their sessions.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "cell/cell.hpp"
#include "server/net/asio.hpp"
#include "server/net/line_transports.hpp"
#include "server/net/listener.hpp"
#include "server/net/memory_limit.hpp"
#include "server/net/peer_counts.hpp"
#include "server/net/wall_clock.hpp"
#include "server/robot_port/line_watch.hpp"
#include "server/robot_port/session.hpp"
#include "server/robot_port/turn_queue.hpp"

namespace xr3 {

/// The progress of the server's own probe of a line (`RobotProbe`).
enum class ProbeProgress : std::uint8_t {
  kUnseen,    ///< its connection is not accepted yet
  kRefused,   ///< all lines were in use
  kAccepted,  ///< its line is open
  kTaken,     ///< its byte has been parsed
  kIgnored,   ///< as kTaken, but the controller is disabled and does not reply
};

struct RobotPortRules {
  std::size_t max_lines;  ///< further connections are closed without a byte
  Guard guard = Guard::kNormal;
  PeerCounts peers = PeerCounts();
};

class RobotPort final : public LineTransports {
 public:
  /// `acted` is called after each input, and when a line has opened or closed.
  RobotPort(asio::io_context& io, Cell& cell, RobotPortRules rules, std::function<void()> acted);
  std::size_t max_lines() const { return rules_.max_lines; }

  /// Counts the lines towards a limit of memory, which must outlive the port.
  void limit_memory(MemoryLimit& limit) { context_.memory = &limit; }
  /// The most bytes that one line holds.
  std::size_t most_held() const;
  /// Closes the line that holds the most bytes. Precondition: most_held() > 0.
  void close_greediest();

  /// Binds and starts to accept; endpoint() is then valid. Returns the error.
  ErrorCode listen(const tcp::endpoint& endpoint);
  tcp::endpoint endpoint() const { return listener_.endpoint(); }

  void read_arrived() override;
  void run_turns() override;
  /// Runs a few turns if the last ones are kTurnsEvery ago. The event loop calls this after every
  /// handler, so that a line waits for one handler at most, however many are ready.
  void run_due_turns();
  static constexpr WallNs kTurnsEvery = 200'000;
  asio::awaitable<bool> wait_for_bytes(LineId line, std::uint64_t bytes_in,
                                       std::chrono::milliseconds within) override;
  bool disconnect(LineId line) override;
  PortCounters counters() const override { return {refused_, listener_.failures()}; }

  /// The next connection from this endpoint is the server's own probe and becomes kProbeLine. It is
  /// refused if the limit of lines is reached, but does not count as a line.
  void expect_probe(const tcp::endpoint& from);
  /// Cancels expect_probe(): another process may get the endpoint from now on.
  void forget_probe() { probe_from_.reset(); }
  ProbeProgress probe_progress() const { return probe_progress_; }

  /// Accepts no further connection; sessions send their outboxes and end. Those that have not begun
  /// to do so at the deadline are closed at once.
  void close(WallNs deadline = kNever);
  bool is_empty() const { return sessions_.empty(); }
  /// Closes the remaining sessions at once.
  void abort();

 private:
  using Sessions = std::map<LineId, std::shared_ptr<RobotSession>>;

  void open(tcp::socket socket);
  bool is_probe(const tcp::socket& socket);
  bool is_full() const;
  void refuse(bool is_probe);
  void refuse_peer(const asio::ip::address& peer);
  void end_probe();
  asio::awaitable<void> run();
  void take_news();
  void run_lightest(WallNs time);
  void run_turn(LineId line);
  void schedule_turns();
  void end(LineId line);
  Sessions sessions() const { return sessions_; }
  std::shared_ptr<RobotSession> greediest() const;

  void notify(LineId line);
  void read_arrived_on(LineId line);

  asio::io_context& io_;
  Cell& cell_;
  RobotPortRules rules_;
  std::function<void()> acted_;
  std::array<char, 64 * 1024> scratch_{};
  RobotSessionContext context_;
  RobotSessionContext probe_context_;
  Listener listener_;
  LineWatch watch_;
  bool is_watching_ = false;
  bool has_logged_full_ = false;
  bool has_logged_peer_ = false;
  std::uint64_t refused_ = 0;
  std::optional<tcp::endpoint> probe_from_;  ///< of the expected probe, until it is accepted
  ProbeProgress probe_progress_ = ProbeProgress::kUnseen;
  TurnQueue turns_;
  bool is_again_ = false;  ///< the next turns are scheduled
  WallNs next_turns_ = 0;  ///< earliest time of the next run_due_turns()
  /// By line; cancelled when its bytes have acted, or it has ended.
  std::multimap<LineId, asio::steady_timer*> waiting_;
  Sessions sessions_;
  bool is_closing_ = false;
};

}  // namespace xr3
