#include "server/http/resources.hpp"

#include <boost/asio/co_spawn.hpp>
#include <stdexcept>
#include <utility>

#include "protocol/files/robot.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/json/text.hpp"
#include "protocol/monitor/model.hpp"
#include "server/files/data_files.hpp"
#include "server/files/png.hpp"
#include "server/http/metrics.hpp"
#include "server/http/web_assets.hpp"
#include "server/net/wall_clock.hpp"
#include "server/options/options.hpp"
#include "tools/drawing/drawing.hpp"
#include "tools/drawing/pbm.hpp"
#include "tools/drawing/svg.hpp"

namespace xr3 {
namespace {

using http::Answer;
using http::Request;

constexpr std::string_view kPng = "/camera.png";
constexpr std::string_view kHealth = "/healthz";
constexpr std::string_view kReady = "/readyz";
constexpr std::string_view kAssets = "/assets/";
constexpr std::string_view kIcon = "/assets/icon.svg";

// The page if the viewer was not built. Without styles: the Content-Security-Policy forbids inline
// ones.
constexpr const char* kNoViewer = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>xr3</title></head><body>
<h1>xr3 runs, but without its viewer</h1>
<p>This binary was built before the viewer's files were there. With npm installed, <code>./run --build</code>
builds both, in this order. Everything else works:</p>
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

Answer forbidden(const char* code, const std::string& message, const std::string& hint) {
  Answer answer = http::error(403, code, message, hint);
  answer.then = http::Then::kClose;
  return answer;
}

bool has_token(std::string_view list, std::string_view wanted) {
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    std::string_view word = list.substr(0, comma);
    list.remove_prefix(std::min(comma + 1, list.size()));
    const std::size_t first = std::min(word.find_first_not_of(" \t"), word.size());
    word = word.substr(first, word.find_last_not_of(" \t") + 1 - first);
    if (word == wanted) return true;
  }
  return false;
}

/// Whether the key is 16 bytes in base64.
bool is_websocket_key(std::string_view key) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  return key.size() == 24 && key.ends_with("==") &&
         key.find_first_not_of(kLetters) == key.size() - 2;
}

Answer upgrade_required() {
  Answer answer = http::error(426, "upgrade_required", "/ws speaks WebSocket, version 13",
                              "connect with a WebSocket client; subprotocol xr3.v1");
  answer.fields = {{"Upgrade", "websocket"}, {"Sec-WebSocket-Version", "13"}};
  answer.fields.push_back({"Connection", "Upgrade"});
  return answer;
}

}  // namespace

// --- Access.

std::optional<Answer> HttpResources::refuse(const Request& request) const {
  const auto hosts = request.values("Host");
  const auto origins = request.values("Origin");
  if (hosts.size() != 1) return http::bad_request("a request has exactly one Host");
  if (origins.size() > 1) return http::bad_request("a request has at most one Origin");
  if (!policy_.is_host_allowed(hosts.front())) {
    return forbidden("wrong_host", "this server does not answer to that Host",
                     "use its IP address or localhost, or start it with --allow-host NAME");
  }
  if (!origins.empty() && !policy_.is_origin_allowed(origins.front(), hosts.front())) {
    return forbidden("wrong_origin", "a page from another origin may not read this",
                     "open the page from this server's own address, or use --allow-origin");
  }
  if (request.method != "GET" && request.method != "HEAD") return http::method_not_allowed();
  if (!request.target.starts_with('/'))
    return http::bad_request("the target is a path that begins with /");
  return std::nullopt;
}

std::optional<Answer> HttpResources::refuse_websocket(const Request& request) {
  const auto versions = request.values("Sec-WebSocket-Version");
  const auto keys = request.values("Sec-WebSocket-Key");
  if (!request.is_upgrade) return upgrade_required();
  if (versions.size() != 1 || versions.front() != "13") return upgrade_required();
  if (keys.size() != 1 || !is_websocket_key(keys.front()))
    return http::bad_request("a WebSocket handshake has one Sec-WebSocket-Key of 16 bytes",
                             "send 16 random bytes in base64, as WebSocket libraries do");
  const auto offers = request.values("Sec-WebSocket-Protocol");
  for (const std::string_view offer : offers) {
    if (has_token(offer, http::kSubprotocol)) return std::nullopt;
  }
  if (offers.empty()) return std::nullopt;
  return http::bad_request("no subprotocol that was offered is known here",
                           "offer xr3.v1, or none");
}

// --- Routes.

struct HttpResources::Route {
  enum class Kind : std::uint8_t {
    kServer,
    kReading,
    kCell
  };  ///< kServer needs no token; kCell accepts ?cell=

  std::string_view path;
  Kind kind;
  Show show;
};

const HttpResources::Route HttpResources::kRoutes[] = {
    {kHealth, Route::Kind::kServer, &HttpResources::health},
    {kReady, Route::Kind::kServer, nullptr},
    {"/schema/v1.json", Route::Kind::kServer, &HttpResources::schema},
    {"/metrics", Route::Kind::kReading, &HttpResources::metrics},
    {"/state", Route::Kind::kCell, &HttpResources::state},
    {"/robot", Route::Kind::kCell, &HttpResources::robot},
    {"/workcell", Route::Kind::kCell, &HttpResources::workcell},
    {kPng, Route::Kind::kCell, nullptr},
    {"/camera.pbm", Route::Kind::kCell, &HttpResources::bitmap},
    {"/view.svg", Route::Kind::kCell, &HttpResources::view},
};

bool HttpResources::is_health_check(const Request& request) {
  return request.path() == kHealth || request.path() == kReady;
}

asio::awaitable<Answer> HttpResources::answer(const Request& request) {
  const std::string_view path = request.path();
  if (wall_now() >= deadline_)
    co_return http::error(503, "not_ready", "the server is stopping", "start it again");
  for (const Route& route : kRoutes) {
    if (route.path != path) continue;
    if (route.kind != Route::Kind::kServer && policy_.is_private())
      co_return http::token_required();
    const auto cell = request.parameter("cell");
    if (route.kind == Route::Kind::kCell && cell && *cell != cell_.name()) {
      co_return http::error(404, "unknown_cell", "there is no such cell",
                            "there is " + cell_.name());
    }
    if (route.kind == Route::Kind::kCell) cell_.catch_up(wall_now());
    if (route.show != nullptr) co_return (this->*route.show)(request);
    if (path == kPng) co_return co_await png();
    co_return co_await readiness();
  }
  co_return page(request);
}

Answer HttpResources::page(const Request& request) const {
  const std::string_view path = request.path();
  const bool is_root = path == "/";
  const bool is_icon = path == "/favicon.ico";  // requested by browsers for the tab
  const bool is_page = is_root || is_icon || path.starts_with(kAssets);
  if (!is_page) return http::not_found("there is nothing here");
  const WebAsset asset = find_web_asset(is_root ? "/index.html" : is_icon ? kIcon : path);
  if (!asset.type.empty())
    return {200, std::string(asset.type), http::Body::of_static(asset.bytes), {}};
  if (is_root) return {200, "text/html; charset=utf-8", http::Body::of_static(kNoViewer), {}};
  return http::not_found("the viewer has no such file");
}

void HttpResources::stop() {
  painter_.stop();
  painter_.join();
}

// --- The server.

Answer HttpResources::health(const Request&) { return http::text(http::Body::of_static("ok\n")); }

asio::awaitable<Answer> HttpResources::readiness() {
  const std::string trouble = co_await not_ready_();
  if (trouble.empty()) co_return http::text(http::Body::of_static("ok\n"));
  co_return http::error(503, "not_ready", trouble, "try again, or start it again");
}

Answer HttpResources::metrics(const Request&) {
  cell_.catch_up(wall_now());
  return {200, kMetricsType, metrics_text(cell_.name(), service_.counters()), {}};
}

Answer HttpResources::schema(const Request&) {
  try {
    return http::json(schema_.get(
        true, [] { return read_file(data_folder() / "schema" / "monitor-v1.schema.json").text; }));
  } catch (const FileError&) {
    return http::not_found("the data folder has no schema");
  }
}

// --- The cell.

Answer HttpResources::state(const Request&) {
  const monitor::Message message =
      service_.current_frame({monitor::Channel::kState, {}, {}})->message;
  return http::json(state_.get(message, [&] { return *message + "\n"; }));
}

Answer HttpResources::robot(const Request&) {
  const Robot& robot = cell_.model().robot();
  return http::json(robot_.get(&robot, [&] { return json_text(robot_to_json(robot)); }));
}

Answer HttpResources::workcell(const Request&) {
  return http::json(workcell_.get(cell_.revision(), [&] {
    return json_text(workcell_to_json(workcell_now(cell_.model(), cell_.state())));
  }));
}

Answer HttpResources::bitmap(const Request&) {
  if (!cell_.model().workcell().camera) return no_camera();
  const ImagePtr image = cell_.camera_image();
  return {200, "image/x-portable-bitmap", bitmap_.get(image, [&] { return to_pbm(*image); }), {}};
}

// Encoded in a thread: it takes up to 2 ms for the largest camera, too long for the event loop.
asio::awaitable<Answer> HttpResources::png() {
  if (!cell_.model().workcell().camera) co_return no_camera();
  const auto paint = [](ImagePtr image) -> asio::awaitable<std::string> {
    co_return to_png(*image);
  };
  const ImagePtr image = cell_.camera_image();
  if (png_.find(image) == nullptr)
    png_.keep(image, co_await asio::co_spawn(painter_, paint(image), asio::use_awaitable));
  co_return Answer{200, "image/png", *png_.find(image), {}};
}

Answer HttpResources::view(const Request& request) {
  const auto vector = request.parameter("vector");
  try {
    const ViewVector from = vector ? parse_view(*vector) : cell_.state().display.view;
    const auto make = [&] {
      return to_svg(drawing(cell_.model(), cell_.state(), from, kUsualPictureWidthPx));
    };
    return {200, "image/svg+xml", view_.get({cell_.revision(), from}, make), {}};
  } catch (const std::invalid_argument&) {
    return http::error(400, "bad_vector", "a view is three whole numbers from -9 to 9, not all 0",
                       "/view.svg?vector=1,1,1");
  }
}

}  // namespace xr3
