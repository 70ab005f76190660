#include "server/monitor_port/connection.hpp"

#include <chrono>
#include <utility>

#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

// A person with netcat waits for a greeting; a program sends first. Browsers open connections
// before they need them, and take a greeting for the answer to the request that they send later:
// no connection of a machine that speaks HTTP is greeted.
constexpr std::chrono::seconds kSilence{3};

}  // namespace

MonitorConnection::MonitorConnection(tcp::socket socket, const tcp::endpoint& peer,
                                     MonitorConnectionContext& context, PeerCounts::Place place)
    : context_(context),
      peer_(peer),
      place_(std::move(place)),
      socket_(std::make_shared<MonitorSocket>(std::move(socket), context.memory)),
      silence_(socket_->executor()) {}

void MonitorConnection::start() {
  spawn_session(socket_->executor(), "monitor", run(), [self = shared_from_this()] {
    self->abort();
    self->silence_.cancel();  // a waiting timer would keep the event loop from ending
    if (self->lines_) self->lines_->retire();
    if (self->websocket_) self->websocket_->retire();
    self->context_.ended(self);
  });
}

asio::awaitable<void> MonitorConnection::run() {
  std::string first_bytes = co_await open();
  if (!socket_->is_open()) co_return;
  const monitor::Protocol protocol = detector_.protocol();
  if (protocol == monitor::Protocol::kTls) {
    context_.tls_refused();
  } else if (protocol == monitor::Protocol::kHttp) {
    http_.emplace(*socket_, context_.resources,
                  [this](std::string head, http::HttpRequest request) {
                    return serve_websocket(std::move(head), std::move(request));
                  });
    co_await http_->run(std::move(first_bytes));
  } else {
    greet();
    co_await lines_->run(std::move(first_bytes), protocol);
  }
}

asio::awaitable<void> MonitorConnection::serve_websocket(std::string head,
                                                         http::HttpRequest request) {
  const std::optional<std::string> cell = request.parameter("cell");
  if (request.path() == http::kLinePath) {
    line_ = LineWebsocket::make(socket_, peer_, context_.service, cell, context_.has_room);
    co_return co_await line_->run(std::move(head));
  }
  WebsocketContent content = monitor_content(context_.service, cell);
  if (request.path() == http::kFoxglovePath) content = co_await foxglove_content(request);
  if (!socket_->is_open()) co_return;
  websocket_ = Websocket::make(socket_, std::move(content));
  co_await websocket_->run(std::move(head));
}

/// Waits for the cell, which is not there with `--continue` until it has gone on.
asio::awaitable<WebsocketContent> MonitorConnection::foxglove_content(http::HttpRequest request) {
  const CellPtr at = context_.resources.cell_of(request);
  co_await at->be_back();
  WebsocketContent content{
      http::subprotocol_for(request), foxglove::kMaxClientBytes,
      [this, at](MessageSink& sink) { return context_.foxglove.open(sink, at); }};
  co_return content;
}

// --- The detector.

/// Reads until the protocol is known. Returns the bytes that belong to that protocol.
asio::awaitable<std::string> MonitorConnection::open() {
  greet_after_silence();
  while (detector_.protocol() == monitor::Protocol::kUndecided && socket_->is_open()) {
    std::string_view bytes = co_await socket_->read();
    if (bytes.empty()) break;
    bytes.remove_prefix(detector_.feed(bytes));
    if (detector_.protocol() == monitor::Protocol::kUndecided) continue;
    silence_.cancel();
    co_return std::string(bytes);
  }
  silence_.cancel();
  co_return std::string();
}

void MonitorConnection::greet_after_silence() {
  run_after(silence_, kSilence, [self = shared_from_this()] {
    if (self->detector_.protocol() != monitor::Protocol::kUndecided) return;
    if (self->context_.speaks_http(self->machine())) return;
    self->detector_.settle_for_lines();
    self->greet();
  });
}

/// Sends `hello`, once.
void MonitorConnection::greet() {
  if (!lines_) lines_ = JsonLines::greet(socket_, context_.service);
}

// --- Memory.

// A connection that was closed ends in a later turn, and has nothing more to give.
std::size_t MonitorConnection::held_bytes() const {
  if (!socket_->is_open()) return 0;
  return (http_ ? http_->held_bytes() : 0) + (lines_ ? lines_->held_bytes() : 0) +
         (websocket_ ? websocket_->held_bytes() : 0) + (line_ ? line_->held_bytes() : 0);
}

// --- The end.

void MonitorConnection::finish() {
  if (lines_) return lines_->finish();
  if (websocket_) return websocket_->finish();
  if (line_) return line_->finish();
  if (http_) return http_->finish();
  abort();
}

void MonitorConnection::abort() {
  silence_.cancel();
  socket_->close();
  if (lines_) lines_->wake();
  if (websocket_) websocket_->wake();
  if (line_) line_->abort();
}

}  // namespace xr3
