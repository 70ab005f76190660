// The process: one io_context, one cell, two ports, signals, and an orderly end.
#pragma once

#include <boost/asio/signal_set.hpp>
#include <string>

#include "server/access.hpp"
#include "server/asio.hpp"
#include "server/cell.hpp"
#include "server/monitor_port.hpp"
#include "server/options.hpp"
#include "server/robot_port.hpp"

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

  /// Serves until SIGTERM or SIGINT, then hands out what is due and returns. Throws ListenError.
  void run();

 private:
  void listen();
  void announce();
  void announce_token(std::uint16_t monitor_port) const;
  void await_signal();
  void stop();
  void acted();
  bool is_ready() const { return stage_ == Stage::kReady; }

  enum class Stage : std::uint8_t { kStarting, kReady, kDraining };

  ServeOptions options_;
  std::string fresh_token_;  ///< to be told to whoever started this; empty: they know it, or none
  asio::io_context io_{1};
  Stage stage_ = Stage::kStarting;
  Cell cell_;
  AccessPolicy policy_;
  RobotPort robot_port_;
  MonitorPort monitor_port_;
  asio::signal_set signals_;
  asio::steady_timer drain_limit_{io_};
};

/// Model from the files that the options name. Throws FileError and DataError.
ModelPtr load_model(const ServeOptions& options);

}  // namespace xr3
