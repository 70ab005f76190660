// The process: one io_context, one cell, two ports, signals, and an orderly end.
#pragma once

#include <boost/asio/signal_set.hpp>
#include <memory>
#include <string>

#include "cell/cell.hpp"
#include "server/monitor_port/access.hpp"
#include "server/monitor_port/port.hpp"
#include "server/net/asio.hpp"
#include "server/options/options.hpp"
#include "server/robot_port/port.hpp"
#include "server/robot_port/probe.hpp"

namespace xr3 {

/// A port that cannot be listened on.
class ListenError : public std::runtime_error {
 public:
  ListenError(ExitCode code, const std::string& what) : std::runtime_error(what), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

class App {
 public:
  /// `token`: what the options' source gave; empty: there is none.
  App(const ServeOptions& options, ModelPtr model, std::string token);

  App(const App&) = delete;
  App& operator=(const App&) = delete;
  ~App();

  /// Serves until SIGTERM or SIGINT, then hands out what is due and returns kGood. An exception out of
  /// any loop or handler ends it at once: it is logged, and the code is kBroken. Throws ListenError.
  ExitCode run();

  /// Where it listens, once run() has begun to serve.
  tcp::endpoint robot_endpoint() const { return robot_port_.endpoint(); }
  tcp::endpoint monitor_endpoint() const { return monitor_port_.endpoint(); }
  /// Work of others can be posted there.
  asio::io_context::executor_type executor() { return io_.get_executor(); }

 private:
  /// Handlers and coroutines that wait can be destroyed while what they refer to is still there.
  class Loop : public asio::io_context {
   public:
    Loop() : asio::io_context(1) {}
    using asio::io_context::shutdown;
  };

  ExitCode serve();
  ExitCode break_off(const char* what);
  void listen();
  void announce();
  void announce_token(std::uint16_t monitor_port) const;
  void await_signal();
  void stop();
  void acted();
  asio::awaitable<std::string> not_ready();

  enum class Stage : std::uint8_t { kStarting, kReady, kDraining, kEnded };

  ServeOptions options_;
  std::string fresh_token_;  ///< to be told to whoever started this; empty: they know it, or none
  /// Given back before a failure is told, since memory may be what is missing.
  std::unique_ptr<char[]> reserve_;
  Loop io_;
  Stage stage_ = Stage::kStarting;
  Cell cell_;
  AccessPolicy policy_;
  RobotPort robot_port_;
  RobotProbe robot_probe_;
  MonitorPort monitor_port_;
  asio::signal_set signals_;
  asio::steady_timer drain_limit_{io_};
};

/// Model from the files that the options name. Throws FileError and DataError.
ModelPtr load_model(const ServeOptions& options);

}  // namespace xr3
