// The HTTP resources of the monitor port: the current cell, pictures of it, health and metrics of
// the server, and the viewer's files. Read-only. Independent of connections.
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
#include "server/net/wall_clock.hpp"

namespace xr3 {

class HttpResources {
 public:
  /// Returns why the server is not ready, as a sentence; empty if it is ready.
  using NotReady = std::function<asio::awaitable<std::string>()>;

  /// The references must outlive it. `not_ready` is called for /readyz.
  HttpResources(Cell& cell, MonitorService& service, const AccessPolicy& policy, NotReady not_ready)
      : cell_(cell), service_(service), policy_(policy), not_ready_(std::move(not_ready)) {}

  /// Stops the thread that encodes images, for the end of the process.
  void stop();

  /// From this wall time on requests get the error `not_ready`.
  void close_at(WallNs deadline) { deadline_ = deadline; }

  /// The error response for a forbidden Host, Origin or method, or an invalid target; else nullopt.
  std::optional<http::Answer> refuse(const http::Request& request) const;

  /// The answer to a request that refuse() accepts. Waits only for a PNG, which a thread encodes,
  /// and for /readyz, which probes the robot port.
  asio::awaitable<http::Answer> answer(const http::Request& request);

  /// Whether the request asks for /healthz or /readyz.
  static bool is_health_check(const http::Request& request);

  /// The error response for an invalid WebSocket handshake; else nullopt.
  static std::optional<http::Answer> refuse_websocket(const http::Request& request);

 private:
  using Show = http::Answer (HttpResources::*)(const http::Request&);
  struct Route;
  static const Route kRoutes[];

  http::Answer page(const http::Request& request) const;

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

  using Revision = std::uint64_t;

  Cell& cell_;
  MonitorService& service_;
  const AccessPolicy& policy_;
  NotReady not_ready_;
  WallNs deadline_ = kNever;
  http::BodyCache<ImagePtr> bitmap_;
  http::BodyCache<ImagePtr> png_;
  http::BodyCache<std::pair<Revision, ViewVector>> view_;
  http::BodyCache<Revision> workcell_;
  http::BodyCache<const Robot*> robot_;
  http::BodyCache<monitor::Message> state_;
  http::BodyCache<bool> schema_;  ///< depends on nothing
  asio::thread_pool painter_{1};
};

}  // namespace xr3
