// One fresh robot for one run of a program: its serial lines on a free TCP port and a
// pseudo-terminal, and a monitor port only on request. Its event loop runs until the run is over.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "cli/options/options.hpp"
#include "server/cells/registry.hpp"
#include "server/cells/seed.hpp"
#include "server/lines/turns.hpp"
#include "server/monitor_port/port.hpp"
#include "server/net/asio.hpp"
#include "server/net/worker.hpp"
#include "server/session/access.hpp"

namespace xr3 {

class RobotHost {
 public:
  /// `options`: of `serve`, for the clock, the lines, and the recording. `pty`: path of a
  /// pseudo-terminal. `listener`: a socket that listens for the serial lines, which the host then
  /// owns; -1 for a free port of loopback. Throws FileError, and std::system_error if no port is
  /// available.
  RobotHost(const ServeOptions& options, const CellSeed& seed, MonitorAccess access,
            const std::string& pty, int listener);
  RobotHost(const RobotHost&) = delete;
  RobotHost& operator=(const RobotHost&) = delete;
  ~RobotHost();

  asio::io_context& io() { return io_; }
  Cell& cell() { return cell_->cell(); }
  std::uint16_t robot_port() const { return cell_->port()->endpoint().port(); }
  /// The monitor port; nullopt if there is none.
  std::optional<std::uint16_t> monitor_port() const;

  /// Calls `on_input` after each input of the cell.
  void on_input(std::function<void()> on_input) { on_input_ = std::move(on_input); }
  /// Runs the event loop until `is_over` returns true, which is called after every handler. Throws
  /// exceptions that leave a handler.
  void run(const std::function<bool()>& is_over);

  /// Closes the ports, after accepting the clients that have arrived, and lets the open lines be
  /// read to their end. Call once.
  void close_ports();
  /// Whether every line has been read to its end.
  bool are_lines_closed();
  /// Closes the remaining lines.
  void abort_lines();
  /// Lets the robot run until nothing moves, but for at most `limit` ticks, whatever its clock.
  void come_to_rest(Tick limit);
  /// Writes the end of the recording, if there is one.
  void finish_recording() { cell_->finish_recording(); }

 private:
  EventLoop io_;
  LineTurns turns_{io_};
  Worker worker_;
  std::function<void()> on_input_;
  bool has_read_arrived_ = false;
  CellContext context_;
  CellRegistry cells_;
  CellPtr cell_;
  AccessPolicy policy_;
  std::optional<MonitorPort> monitor_;
};

}  // namespace xr3
