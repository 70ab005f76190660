// Connections beyond the limit of the monitor port: each receives an error in its protocol and is
// closed. Only health checks are answered, so that a full port still looks alive.
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>

#include "server/net/asio.hpp"
#include "server/net/socket.hpp"
#include "server/resources/resources.hpp"

namespace xr3 {

class Refusals {
 public:
  /// Closes the oldest of more than `max` connections without an error. `resources`
  /// answer health checks and must outlive it. `ended` is called when a connection has ended.
  Refusals(HttpResources& resources, std::size_t max, std::function<void()> ended)
      : resources_(resources), max_(max), ended_(std::move(ended)) {}

  /// Waits up to 1 s for a request, then answers GET /healthz and /readyz, sends status 503 to
  /// other HTTP, nothing to TLS, and `bye` otherwise.
  void add(tcp::socket socket);
  /// Closes them all.
  void abort();
  bool is_empty() const { return sockets_.empty(); }

 private:
  HttpResources& resources_;
  std::size_t max_;
  std::function<void()> ended_;
  std::list<std::shared_ptr<MonitorSocket>> sockets_;  ///< in the order of arrival
};

}  // namespace xr3
