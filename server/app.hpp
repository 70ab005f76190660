// The process: one io_context, one cell, two ports, signals, and an orderly shutdown.
#pragma once

#include <boost/asio/signal_set.hpp>
#include <memory>
#include <optional>
#include <string>

#include "cell/cell.hpp"
#include "server/device/port.hpp"
#include "server/files/port_file.hpp"
#include "server/lines/due_timer.hpp"
#include "server/monitor_port/access.hpp"
#include "server/monitor_port/port.hpp"
#include "server/net/asio.hpp"
#include "server/net/memory_limit.hpp"
#include "server/net/service_manager.hpp"
#include "server/net/socket_limits.hpp"
#include "server/options/options.hpp"
#include "server/pty/port.hpp"
#include "server/recording/recording.hpp"
#include "server/robot_port/port.hpp"
#include "server/robot_port/probe.hpp"

namespace xr3 {

/// The server cannot listen on a port.
class ListenError : public std::runtime_error {
 public:
  ListenError(ExitCode code, const std::string& what) : std::runtime_error(what), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

class App {
 public:
  /// `token`: as read from the source in the options; empty: none.
  App(const ServeOptions& options, ModelPtr model, std::string token);

  App(const App&) = delete;
  App& operator=(const App&) = delete;
  ~App();

  /// The faults of the start; see Cell::set_faults().
  void set_faults(FaultPlan plan) { cell_.set_faults(std::move(plan)); }

  /// Lets `replay` bring the fresh cell, to which it may apply inputs, to the state with which this
  /// server begins. Its lines are closed after it, and its events are not logged.
  void begin_with(const std::function<void(Cell&)>& replay);

  /// Serves until SIGTERM, SIGINT or SIGHUP, then sends pending replies and returns kGood. An
  /// exception from any loop or handler ends it at once: it is logged, and the result is kBroken.
  /// Throws ListenError, and FileError if a file or pseudo-terminal cannot be made.
  ExitCode run();

  /// Valid once run() has begun to serve.
  tcp::endpoint robot_endpoint() const { return robot_port_.endpoint(); }
  tcp::endpoint monitor_endpoint() const { return monitor_port_.endpoint(); }
  /// For posting work to the event loop.
  asio::io_context::executor_type executor() { return io_.get_executor(); }

 private:
  /// Makes shutdown() public. It destroys waiting handlers and coroutines; the objects that they
  /// refer to must still exist.
  class Loop : public asio::io_context {
   public:
    Loop() : asio::io_context(1) {}
    using asio::io_context::shutdown;
  };

  ExitCode serve();
  ExitCode break_off(const char* what);
  void listen();
  void open_terminals();
  void connect_device();
  void start_recording();
  void open_device();
  void announce();
  void announce_token(std::uint16_t monitor_port) const;
  void await_signal();
  void stop();
  void end_soon();
  void acted();
  std::size_t close_greediest();
  asio::awaitable<std::string> not_ready();

  enum class Stage : std::uint8_t { kStarting, kReady, kDraining, kEnded };

  ServeOptions options_;
  std::string fresh_token_;  ///< generated for this run, to be printed; else empty
  /// Freed before a failure is logged, since memory may be exhausted.
  std::unique_ptr<char[]> reserve_;
  Loop io_;
  Stage stage_ = Stage::kStarting;
  bool is_replaying_ = false;
  Cell cell_;
  std::optional<Recording> recording_;
  AccessPolicy policy_;
  SocketLimits limits_;
  MemoryLimit memory_;
  LineSessions lines_;
  DueTimer due_timer_;
  RobotPort robot_port_;
  PtyPort ptys_;
  std::optional<DevicePort> device_;
  RobotProbe robot_probe_;
  MonitorPort monitor_port_;
  ServiceManager service_manager_;
  asio::signal_set signals_;
  std::optional<PortFile> port_file_;
  asio::steady_timer drain_limit_{io_};
};

}  // namespace xr3
