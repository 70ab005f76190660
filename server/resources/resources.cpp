#include "server/resources/resources.hpp"

#include <stdexcept>
#include <utility>

#include "protocol/files/robot.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/json/text.hpp"
#include "protocol/monitor/model.hpp"
#include "server/files/data_files.hpp"
#include "server/net/wall_clock.hpp"
#include "server/options/cells.hpp"
#include "server/resources/metrics.hpp"
#include "server/resources/process_stats.hpp"
#include "server/resources/web_assets.hpp"
#include "tools/drawing/picture.hpp"
#include "tools/drawing/svg.hpp"
#include "tools/drawing/view_vector.hpp"

namespace xr3 {
namespace {

using http::Answer;
using http::HttpRequest;

constexpr std::string_view kHealth = "/healthz";
constexpr std::string_view kReady = "/readyz";
constexpr std::string_view kAssets = "/assets/";
constexpr std::string_view kCellPage = "/cell/";
constexpr std::string_view kIcon = "/assets/icon.svg";

// The page if the viewer was not built. Without styles: the Content-Security-Policy forbids inline
// ones.
constexpr const char* kNoViewer = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>xr3</title></head><body>
<h1>xr3 runs, but without its viewer</h1>
<p>This binary was built before the viewer's files were there. With npm installed,
<code>./run --build</code> builds both, in this order. Everything else works:</p>
<ul>
<li><a href="/view.svg">the robot now</a>, <a href="/camera.png">what its camera sees</a></li>
<li><a href="/state">state</a>, <a href="/robot">robot</a>, <a href="/workcell">workcell</a>,
<a href="/metrics">metrics</a>, <a href="/schema/v1.json">schema of the messages</a></li>
</ul></body></html>
)";

Answer no_camera() {
  return http::error(404, "no_camera", "this workcell has no camera",
                     "start with a workcell that has one, such as rhino-xr3");
}

/// Whether the key is 16 bytes in base64.
bool is_websocket_key(std::string_view key) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  return key.size() == 24 && key.ends_with("==") &&
         key.find_first_not_of(kLetters) == key.size() - 2;
}

/// The token that a request carries (RFC 6750, section 2.1); nullopt if it has none, or several.
std::optional<std::string_view> bearer_token(const HttpRequest& request) {
  constexpr std::string_view kScheme = "Bearer ";
  const auto values = request.values("Authorization");
  if (values.size() != 1) return std::nullopt;
  if (!http::is_same_name(values.front().substr(0, kScheme.size()), kScheme)) return std::nullopt;
  return values.front().substr(kScheme.size());
}

Answer unknown_cell(const CellRegistry& cells) {
  const std::string hint = cells.is_empty() ? "there is no cell now"
                           : cells.is_single()
                               ? "there is " + cells.all().front()->name()
                               : "such as " + cells.all().front()->name() + "; hello lists all";
  return http::error(404, "unknown_cell", "there is no such cell", hint);
}

/// `foxglove.sdk.v1 or foxglove.websocket.v1`.
std::string subprotocols_text(std::string_view path) {
  std::string text;
  for (const std::string_view each : http::subprotocols_of(path))
    text.append(text.empty() ? "" : " or ").append(each);
  return text;
}

Answer upgrade_required(std::string_view path) {
  Answer answer =
      http::error(426, "upgrade_required", std::string(path) + " speaks WebSocket, version 13",
                  "connect with a WebSocket client; subprotocol " + subprotocols_text(path));
  answer.fields = {{"Upgrade", "websocket"}, {"Sec-WebSocket-Version", "13"}};
  answer.fields.push_back({"Connection", "Upgrade"});
  return answer;
}

// A client of Foxglove cannot send a token, and it shows a cell.
Answer private_foxglove() {
  return http::error(403, "token_required",
                     "reading needs the token (--private), which Foxglove clients cannot send",
                     "start the server without --private, or connect to /ws");
}

}  // namespace

HttpResources::HttpResources(MonitorService& service, const AccessPolicy& policy,
                             NotReady not_ready, Count count)
    : service_(service),
      policy_(policy),
      not_ready_(std::move(not_ready)),
      count_(std::move(count)),
      sites_(service.worker()) {}

// --- Access.

std::optional<Answer> HttpResources::refuse(const HttpRequest& request) const {
  const auto hosts = request.values("Host");
  const auto origins = request.values("Origin");
  if (hosts.size() != 1) return http::bad_request("a request has exactly one Host");
  if (origins.size() > 1) return http::bad_request("a request has at most one Origin");
  if (!policy_.is_host_allowed(hosts.front())) {
    return http::closing(
        http::error(403, "wrong_host", "this server does not answer to that Host",
                    "use its IP address or localhost, or start it with --allow-host NAME"));
  }
  if (!origins.empty() && !is_origin_allowed(request, origins.front(), hosts.front())) {
    return http::closing(
        http::error(403, "wrong_origin", "a page from another origin may not read this",
                    "open the page from this server's own address, or use --allow-origin"));
  }
  if (request.method != "GET" && request.method != "HEAD") return http::method_not_allowed();
  if (!request.target.starts_with('/'))
    return http::bad_request("the target is a path that begins with /");
  return std::nullopt;
}

/// Desktop apps have no origin of their own; --allow-origin desktop admits them to one path.
bool HttpResources::is_origin_allowed(const HttpRequest& request, std::string_view origin,
                                      std::string_view host) const {
  return policy_.is_origin_allowed(origin, host) ||
         (request.path() == http::kFoxglovePath && policy_.is_desktop_allowed(origin));
}

std::optional<Answer> HttpResources::refuse_websocket(const HttpRequest& request) const {
  const auto versions = request.values("Sec-WebSocket-Version");
  const auto keys = request.values("Sec-WebSocket-Key");
  if (!request.is_upgrade) return upgrade_required(request.path());
  if (versions.size() != 1 || versions.front() != "13") return upgrade_required(request.path());
  if (keys.size() != 1 || !is_websocket_key(keys.front()))
    return http::bad_request("a WebSocket handshake has one Sec-WebSocket-Key of 16 bytes",
                             "send 16 random bytes in base64, as WebSocket libraries do");
  if (http::subprotocol_for(request).empty())
    return http::bad_request("no subprotocol that was offered is known here",
                             "offer " + subprotocols_text(request.path()) + ", or none");
  if (request.path() != http::kFoxglovePath) return refuse_cell(request);
  if (policy_.is_private()) return private_foxglove();
  if (!cell_of(request)) return unknown_cell(service_.cells());
  return std::nullopt;
}

// --- Routes.

struct HttpResources::Route {
  enum class RouteKind : std::uint8_t {
    kServer,
    kMetrics,
    kCell
  };  ///< kServer needs no token, kMetrics may have its own; kCell accepts ?cell=

  std::string_view path;
  RouteKind kind;
  Show show;
};

const HttpResources::Route HttpResources::kRoutes[] = {
    {kHealth, Route::RouteKind::kServer, &HttpResources::health},
    {kReady, Route::RouteKind::kServer, &HttpResources::readiness},
    {"/schema/v1.json", Route::RouteKind::kServer, &HttpResources::schema},
    {"/sites", Route::RouteKind::kServer, &HttpResources::sites},
    {"/metrics", Route::RouteKind::kMetrics, &HttpResources::metrics},
    {"/state", Route::RouteKind::kCell, &HttpResources::state},
    {"/robot", Route::RouteKind::kCell, &HttpResources::robot},
    {"/workcell", Route::RouteKind::kCell, &HttpResources::workcell},
    {"/camera.png", Route::RouteKind::kCell, &HttpResources::png},
    {"/camera.pbm", Route::RouteKind::kCell, &HttpResources::bitmap},
    {"/view.svg", Route::RouteKind::kCell, &HttpResources::view},
};

bool HttpResources::is_health_check(const HttpRequest& request) {
  return request.path() == kHealth || request.path() == kReady;
}

asio::awaitable<Answer> HttpResources::answer(const HttpRequest& request) {
  service_.measure_loop();
  const std::string_view path = request.path();
  if (wall_now() >= deadline_)
    co_return http::error(503, "not_ready", "the server is stopping", "start it again");
  for (const Route& route : kRoutes) {
    if (route.path != path) continue;
    std::optional<Answer> refused = co_await refuse_reading(route, request);
    if (refused) co_return *std::move(refused);
    CellPtr at = route.kind == Route::RouteKind::kCell ? cell_of(request) : nullptr;
    if (route.kind == Route::RouteKind::kCell && !at) co_return unknown_cell(service_.cells());
    if (at) co_await at->be_back();
    if (at) at->cell().catch_up(wall_now());
    co_return co_await (this->*route.show)(std::move(at), request);
  }
  if (Sites::has(path)) co_return co_await sites_.answer(std::string(path));
  co_return page(request);
}

/// The answer to a request that lacks the token that a private server requires; else nullopt.
asio::awaitable<std::optional<Answer>> HttpResources::refuse_reading(const Route& route,
                                                                     const HttpRequest& request) {
  if (route.kind == Route::RouteKind::kServer || !policy_.is_private()) co_return std::nullopt;
  if (route.kind != Route::RouteKind::kMetrics || !policy_.has_metrics_token())
    co_return http::token_required();
  const std::optional<std::string_view> token = bearer_token(request);
  if (!token) co_return http::metrics_token_required();
  if (policy_.is_right_for_metrics(*token)) co_return std::nullopt;
  co_await service_.sessions().wrong_tokens().delay();
  co_return http::bad_metrics_token();
}

CellPtr HttpResources::cell_of(const HttpRequest& request) const {
  const auto name = request.parameter("cell");
  if (name) return service_.cells().find(*name);
  return service_.cells().is_empty() ? nullptr : service_.cells().all().front();
}

/// The error response if a page or session for an unknown cell is requested. With --private the
/// names of cells are secret without a token: the session gets no cell instead.
std::optional<Answer> HttpResources::refuse_cell(const HttpRequest& request) const {
  const bool is_known = !request.parameter("cell") || cell_of(request);
  if (is_known || policy_.is_private()) return std::nullopt;
  return unknown_cell(service_.cells());
}

Answer HttpResources::page(const HttpRequest& request) const {
  const std::string_view path = request.path();
  const bool is_of_cell =
      path.starts_with(kCellPage) && is_cell_name(path.substr(kCellPage.size()));
  const bool is_root = path == "/" || is_of_cell;
  const bool is_icon = path == "/favicon.ico";  // requested by browsers for the tab
  const bool is_page = is_root || is_icon || path.starts_with(kAssets);
  if (!is_page) return http::not_found("there is nothing here");
  if (is_root)
    if (auto refused = refuse_cell(request)) return *std::move(refused);
  std::vector<http::Field> fields;
  if (is_root) fields = {{"Content-Security-Policy", http::page_policy(policy_.frame_origins())}};
  const WebAsset asset = find_web_asset(is_root ? "/index.html" : is_icon ? kIcon : path);
  if (!asset.type.empty())
    return {200, std::string(asset.type), http::Body::of_static(asset.bytes), std::move(fields)};
  if (is_root)
    return {200, "text/html; charset=utf-8", http::Body::of_static(kNoViewer), std::move(fields)};
  return http::not_found("the viewer has no such file");
}

// --- The server.

asio::awaitable<Answer> HttpResources::health(CellPtr, HttpRequest) {
  co_return http::text(http::Body::of_static("ok\n"));
}

asio::awaitable<Answer> HttpResources::readiness(CellPtr, HttpRequest) {
  const std::string trouble = not_ready_();
  if (trouble.empty()) co_return http::text(http::Body::of_static("ok\n"));
  co_return http::error(503, "not_ready", trouble, "try again, or start it again");
}

asio::awaitable<Answer> HttpResources::metrics(CellPtr, HttpRequest) {
  CellRegistry& cells = service_.cells();
  co_await service_.overview().summaries();  // advances all cells, but not all at once
  const std::string cell = cells.is_single() ? cells.all().front()->name() : "";
  co_return Answer{200, kMetricsType, metrics_text(cell, count_(), process_stats()), {}};
}

asio::awaitable<Answer> HttpResources::schema(CellPtr, HttpRequest) {
  try {
    if (schema_.bytes().empty())
      schema_ = read_file(data_folder() / "schema" / "monitor-v1.schema.json").text;
    co_return http::json(schema_);
  } catch (const FileError&) {
    co_return http::not_found("the data folder has no schema");
  }
}

asio::awaitable<Answer> HttpResources::sites(CellPtr, HttpRequest) {
  co_return co_await sites_.list();
}

// --- The cell.

asio::awaitable<Answer> HttpResources::state(CellPtr at, HttpRequest) {
  const monitor::Selection whole{monitor::Channel::kState, {}, {}};
  co_return http::json(*at->frames().frame(whole)->message + "\n");
}

asio::awaitable<Answer> HttpResources::robot(CellPtr at, HttpRequest) {
  co_return http::json(json_text(robot_to_json(at->cell().model().robot())));
}

asio::awaitable<Answer> HttpResources::workcell(CellPtr at, HttpRequest) {
  const Workcell now = workcell_now(at->cell().model(), at->cell().state());
  co_return http::json(json_text(workcell_to_json(now)));
}

asio::awaitable<Answer> HttpResources::bitmap(CellPtr at, HttpRequest) {
  const ImagePtr image = at->cell().camera_image();
  if (!image) co_return no_camera();
  co_return Answer{200, "image/x-portable-bitmap", at->pictures().bitmap(image), {}};
}

asio::awaitable<Answer> HttpResources::png(CellPtr at, HttpRequest) {
  const ImagePtr image = at->cell().camera_image();
  if (!image) co_return no_camera();
  const http::Body body = co_await at->pictures().png(image);
  co_return Answer{200, "image/png", body, {}};
}

asio::awaitable<Answer> HttpResources::view(CellPtr at, HttpRequest request) {
  const auto vector = request.parameter("vector");
  ViewVector from = at->cell().state().display.view;
  try {
    if (vector) from = parse_view(*vector);
  } catch (const std::invalid_argument&) {
    co_return http::error(400, "bad_vector",
                          "a view is three whole numbers from -9 to 9, not all 0",
                          "/view.svg?vector=1,1,1");
  }
  const std::string svg =
      to_svg(drawing(at->cell().model(), at->cell().state(), from, kUsualPictureWidthPx));
  co_return Answer{200, "image/svg+xml", svg, {}};
}

}  // namespace xr3
