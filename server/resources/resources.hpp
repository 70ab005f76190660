// The HTTP resources of the monitor port: the cells now, pictures of them, health and metrics of
// the server, the viewer's files, and the sites. Read-only. Independent of connections.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "cell/cell.hpp"
#include "server/http/answer.hpp"
#include "server/http/body.hpp"
#include "server/net/asio.hpp"
#include "server/net/wall_clock.hpp"
#include "server/resources/sites.hpp"
#include "server/service/service.hpp"
#include "server/session/access.hpp"

namespace xr3 {

class HttpResources {
 public:
  /// Returns why the server is not ready, as a sentence; empty if it is ready.
  using NotReady = std::function<std::string()>;

  /// Returns the statistics of the server.
  using Count = std::function<CellCounters()>;

  /// The references must outlive it. `not_ready` is called for /readyz, `count` for /metrics.
  HttpResources(MonitorService& service, const AccessPolicy& policy, NotReady not_ready,
                Count count);

  /// From this wall time on requests get the error `not_ready`.
  void close_at(WallNs deadline) { deadline_ = deadline; }

  /// The error response for a forbidden Host, Origin or method, or an invalid target; else nullopt.
  std::optional<http::Answer> refuse(const http::HttpRequest& request) const;

  /// The answer to a request that refuse() accepts. Waits for /camera.png and for the sites, for
  /// which the worker works, and for /metrics, which advances all cells.
  asio::awaitable<http::Answer> answer(const http::HttpRequest& request);

  /// Whether the request asks for /healthz or /readyz.
  static bool is_health_check(const http::HttpRequest& request);

  /// The error response for a WebSocket handshake that is invalid, or for an unknown cell; else
  /// nullopt.
  std::optional<http::Answer> refuse_websocket(const http::HttpRequest& request) const;

  /// The cell in the query, or the first one; nullptr if there is none.
  CellPtr cell_of(const http::HttpRequest& request) const;

 private:
  /// The cell is null for a resource of the server.
  using Show = asio::awaitable<http::Answer> (HttpResources::*)(CellPtr, http::HttpRequest);
  struct Route;
  static const Route kRoutes[];

  asio::awaitable<std::optional<http::Answer>> refuse_reading(const Route& route,
                                                              const http::HttpRequest& request);
  bool is_origin_allowed(const http::HttpRequest& request, std::string_view origin,
                         std::string_view host) const;
  http::Answer page(const http::HttpRequest& request) const;

  asio::awaitable<http::Answer> health(CellPtr at, http::HttpRequest request);
  asio::awaitable<http::Answer> readiness(CellPtr at, http::HttpRequest request);
  asio::awaitable<http::Answer> metrics(CellPtr at, http::HttpRequest request);
  asio::awaitable<http::Answer> state(CellPtr at, http::HttpRequest request);
  asio::awaitable<http::Answer> robot(CellPtr at, http::HttpRequest request);
  asio::awaitable<http::Answer> workcell(CellPtr at, http::HttpRequest request);
  asio::awaitable<http::Answer> schema(CellPtr at, http::HttpRequest request);
  asio::awaitable<http::Answer> sites(CellPtr at, http::HttpRequest request);
  asio::awaitable<http::Answer> bitmap(CellPtr at, http::HttpRequest request);
  asio::awaitable<http::Answer> png(CellPtr at, http::HttpRequest request);
  asio::awaitable<http::Answer> view(CellPtr at, http::HttpRequest request);

  std::optional<http::Answer> refuse_cell(const http::HttpRequest& request) const;

  MonitorService& service_;
  const AccessPolicy& policy_;
  NotReady not_ready_;
  Count count_;
  WallNs deadline_ = kNever;
  Sites sites_;
  http::Body schema_;  ///< empty before the first request
};

}  // namespace xr3
