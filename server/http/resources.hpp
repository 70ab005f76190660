// What there is to GET on the monitor port: the cell as it is now, pictures of it, the server's
// health and counters, and the viewer's files. Nothing here changes anything. It knows no connection.
#pragma once

#include <boost/asio/thread_pool.hpp>
#include <functional>
#include <optional>
#include <string_view>

#include "cell/cell.hpp"
#include "server/http/answer.hpp"
#include "server/monitor_port/access.hpp"
#include "server/monitor_port/service.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

class HttpResources {
 public:
  /// Why the server takes no work, as a sentence; nothing where it does.
  using NotReady = std::function<asio::awaitable<std::string>()>;

  /// All of them outlive it. `not_ready` is what /readyz asks.
  HttpResources(Cell& cell, MonitorService& service, const AccessPolicy& policy, NotReady not_ready)
      : cell_(cell), service_(service), policy_(policy), not_ready_(std::move(not_ready)) {}

  /// Nothing is painted any more: the process ends.
  void stop();

  /// Why a request is not let in, whatever it asks for: Host, Origin, method.
  std::optional<http::Answer> refuse(const http::Request& request) const;

  /// The answer to a request that was let in. A PNG is made beside the loop, and /readyz asks down a
  /// line; nothing else waits.
  asio::awaitable<http::Answer> answer(const http::Request& request);

  /// Why a request for /ws cannot become a WebSocket.
  static std::optional<http::Answer> refuse_websocket(const http::Request& request);

 private:
  using Show = http::Answer (HttpResources::*)(const http::Request&);
  struct Route;
  static const Route kRoutes[];

  http::Answer page(const http::Request& request) const;
  std::optional<http::Answer> refuse_reading(const http::Request& request) const;

  http::Answer health(const http::Request& request);
  http::Answer metrics(const http::Request& request);
  http::Answer state(const http::Request& request);
  http::Answer robot(const http::Request& request);
  http::Answer workcell(const http::Request& request);
  http::Answer schema(const http::Request& request);
  http::Answer bitmap(const http::Request& request);
  http::Answer view(const http::Request& request);
  asio::awaitable<http::Answer> readiness();
  asio::awaitable<http::Answer> png();

  Cell& cell_;
  MonitorService& service_;
  const AccessPolicy& policy_;
  NotReady not_ready_;
  asio::thread_pool painter_{1};
};

}  // namespace xr3
