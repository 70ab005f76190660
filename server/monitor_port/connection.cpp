#include "server/monitor_port/connection.hpp"

#include <chrono>
#include <utility>

#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

// A person with netcat waits for a greeting; a program sends first.
constexpr std::chrono::seconds kSilence{1};

}  // namespace

MonitorSession::MonitorSession(tcp::socket socket, MonitorContext& context)
    : context_(context),
      socket_(std::make_shared<MonitorSocket>(std::move(socket))),
      silence_(socket_->executor()) {}

void MonitorSession::start() {
  spawn_session(socket_->executor(), "monitor", run(), [self = shared_from_this()] {
    self->abort();
    if (self->lines_) self->lines_->retire();
    if (self->websocket_) self->websocket_->retire();
    self->context_.ended(self);
  });
}

asio::awaitable<void> MonitorSession::run() {
  std::string first_bytes = co_await open();
  co_await speak(std::move(first_bytes));
}

// --- The opening.

/// Reads until it is clear what the client speaks, and returns what it has said of that.
asio::awaitable<std::string> MonitorSession::open() {
  greet_after_silence();
  while (opening_.tongue() == monitor::Tongue::kUndecided && socket_->is_open()) {
    std::string_view bytes = co_await socket_->read();
    if (bytes.empty()) break;
    bytes.remove_prefix(opening_.take(bytes));
    if (opening_.tongue() == monitor::Tongue::kUndecided) continue;
    silence_.cancel();
    co_return std::string(bytes);
  }
  silence_.cancel();
  co_return std::string();
}

void MonitorSession::greet_after_silence() {
  silence_.expires_after(kSilence);
  silence_.async_wait([self = shared_from_this()](ErrorCode cancelled) {
    if (cancelled || self->opening_.tongue() != monitor::Tongue::kUndecided) return;
    self->opening_.settle_for_lines();
    self->greet();
  });
}

/// Says hello, once.
void MonitorSession::greet() {
  if (!lines_) lines_ = JsonLines::greet(socket_, context_.service);
}

asio::awaitable<void> MonitorSession::speak(std::string first_bytes) {
  if (!socket_->is_open()) co_return;
  const monitor::Tongue tongue = opening_.tongue();
  if (tongue == monitor::Tongue::kTls) {
    context_.tls_refused();
  } else if (tongue == monitor::Tongue::kHttp) {
    co_await speak_http(std::move(first_bytes));
  } else {
    greet();
    co_await lines_->run(std::move(first_bytes), tongue);
  }
}

// --- HTTP.

asio::awaitable<void> MonitorSession::speak_http(std::string first_bytes) {
  http_.emplace(*socket_, context_.resources,
                [this](std::string head) { return speak_websocket(std::move(head)); });
  co_await http_->run(std::move(first_bytes));
}

asio::awaitable<void> MonitorSession::speak_websocket(std::string head) {
  websocket_ = Websocket::make(socket_, context_.service);
  co_await websocket_->run(std::move(head));
}

// --- The end.

void MonitorSession::finish() {
  if (lines_) return lines_->finish();
  if (websocket_) return websocket_->finish();
  if (http_) return http_->finish();
  abort();
}

void MonitorSession::abort() {
  silence_.cancel();
  socket_->close();
  if (lines_) lines_->wake();
  if (websocket_) websocket_->wake();
}

}  // namespace xr3
