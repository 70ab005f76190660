// Reports to a service manager such as systemd that the server is ready, alive or stopping:
// datagrams to the socket in NOTIFY_SOCKET, as in sd_notify(3). Without that variable it does
// nothing. Why not with libsystemd: docs/decisions/0015-service-manager.md.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "server/net/asio.hpp"

namespace xr3 {

/// The settings that a service manager passes to its services in the environment.
struct ServiceEnvironment {
  std::string socket;  ///< path; with `@` first an abstract name; empty: there is no manager
  std::optional<std::chrono::microseconds> watchdog;  ///< maximum time between two signs of life
};

/// From NOTIFY_SOCKET, and from WATCHDOG_USEC unless WATCHDOG_PID names another process. Values
/// that make no sense count as absent and are logged.
ServiceEnvironment service_environment();

class ServiceManager {
 public:
  /// Returns why the server does not work, as a sentence; empty if it works.
  using Failure = std::function<asio::awaitable<std::string>()>;

  /// `failure` is called before each sign of life.
  ServiceManager(asio::io_context& io, ServiceEnvironment environment, Failure failure);
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

  /// Clients can connect. From now on signs of life are sent, if the manager asks for them.
  void ready();
  /// The server stops: no further sign of life.
  void stopping();

 private:
  asio::awaitable<void> show_life(std::chrono::microseconds period);
  void send(std::string_view state);

  asio::io_context& io_;
  ServiceEnvironment environment_;
  Failure failure_;
  asio::steady_timer timer_;
  bool is_stopping_ = false;
};

}  // namespace xr3
