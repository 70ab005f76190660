// Reports to a service manager such as systemd that the server is ready, alive or stopping:
// datagrams to the socket in NOTIFY_SOCKET, as in sd_notify(3). Without that variable it does
// nothing. docs/decisions/0015-service-manager.md has the reasons for not using libsystemd.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "server/net/asio.hpp"

namespace xr3 {

/// The settings that a service manager passes to its services in the environment.
struct ServiceEnvironment {
  std::string socket;  ///< path; an abstract name begins with `@`; empty if there is no manager
  std::optional<std::chrono::microseconds> watchdog;  ///< maximum time between two signs of life
};

/// The environment from NOTIFY_SOCKET, and from WATCHDOG_USEC unless WATCHDOG_PID names another
/// process. Invalid values count as absent and are logged.
ServiceEnvironment service_environment();

class ServiceManager {
 public:
  ServiceManager(asio::io_context& io, ServiceEnvironment environment);
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

  /// Clients can connect. If the manager asks for signs of life, a timer sends them: each after all
  /// handlers that were ready in the event loop have run.
  void ready();
  /// Reports that the server stops; ends signs of life.
  void stopping();

 private:
  asio::awaitable<void> show_life(std::chrono::microseconds period);
  void send(std::string_view state);

  asio::io_context& io_;
  ServiceEnvironment environment_;
  asio::steady_timer timer_;
  bool is_stopping_ = false;
};

}  // namespace xr3
