#include "server/monitor_session.hpp"

#include <spdlog/spdlog.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/post.hpp>
#include <chrono>
#include <utility>

#include "protocol/http_probe.hpp"

namespace xr3 {
namespace {

// A person with netcat waits for a greeting; a program sends first.
constexpr std::chrono::seconds kSilence{1};
constexpr std::chrono::seconds kMostHttpHead{10};
// Messages gathered for one write.
constexpr std::size_t kBatchBytes = 64 * 1024;
// Requests of one client in one turn of the loop, so that a flood leaves room for the lines.
constexpr int kFairShare = 16;

constexpr auto kNever = asio::steady_timer::time_point::max();

void tell_failure(const std::exception_ptr& failure) {
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const std::exception& error) {
    spdlog::error("monitor: a connection has failed: {}", error.what());
  }
}

}  // namespace

MonitorSession::MonitorSession(tcp::socket socket, MonitorContext& context)
    : context_(context),
      socket_(std::move(socket)),
      client_(context.service.cells()),
      silence_(socket_.executor()),
      to_write_(socket_.executor(), kNever),
      written_(socket_.executor(), kNever) {}

void MonitorSession::start() {
  asio::co_spawn(
      socket_.executor(), [self = shared_from_this()] { return self->run(); },
      [self = shared_from_this()](const std::exception_ptr& failure) {
        tell_failure(failure);
        self->abort();
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
  while (opening_.tongue() == monitor::Tongue::kUndecided && socket_.is_open()) {
    std::string_view bytes = co_await socket_.read();
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

/// Says hello, once, and starts the writer.
void MonitorSession::greet() {
  if (std::exchange(is_greeted_, true)) return;
  client_.send(context_.service.hello());
  asio::co_spawn(
      socket_.executor(), [self = shared_from_this()] { return self->write_messages(); },
      [self = shared_from_this()](const std::exception_ptr& failure) {
        tell_failure(failure);
        if (failure) self->abort();
        self->is_written_ = true;
        self->written_.cancel();
      });
}

asio::awaitable<void> MonitorSession::speak(std::string first_bytes) {
  if (!socket_.is_open()) co_return;
  const monitor::Tongue tongue = opening_.tongue();
  if (tongue == monitor::Tongue::kTls) {
    context_.tls_refused();
  } else if (tongue == monitor::Tongue::kHttp) {
    co_await speak_http(std::move(first_bytes));
  } else {
    co_await speak_lines(std::move(first_bytes));
  }
}

// --- JSON lines.

asio::awaitable<void> MonitorSession::speak_lines(std::string first_bytes) {
  greet();
  if (opening_.tongue() == monitor::Tongue::kNotJson) client_.end(monitor::Bye::kNotJson);
  lines_.take(first_bytes);
  bool has_more = !first_bytes.empty();
  while (socket_.is_open()) {
    co_await answer_lines();
    if (client_.has_ended() || !has_more) break;
    const std::string_view bytes = co_await socket_.read();
    has_more = !bytes.empty();
    lines_.take(bytes);
    if (!has_more) lines_.end();
  }
  is_answered_ = true;
  co_await until_all_is_written();
  co_await socket_.linger();
}

/// Carries out what the lines ask for, one after the other, while the client takes the answers.
asio::awaitable<void> MonitorSession::answer_lines() {
  for (int answered = 1; socket_.is_open() && !client_.has_ended(); ++answered) {
    co_await until_there_is_room();
    auto request = monitor::next_request(lines_, client_);
    to_write_.cancel();
    if (!request && client_.is_full()) continue;
    if (!request) co_return;
    auto answer = co_await context_.service.answer(std::move(*request));
    client_.send(std::move(answer));
    to_write_.cancel();
    if (answered % kFairShare == 0) co_await asio::post(socket_.executor(), asio::use_awaitable);
  }
}

asio::awaitable<void> MonitorSession::until_there_is_room() {
  while (client_.is_full() && socket_.is_open()) co_await written_.async_wait(kAwait);
}

asio::awaitable<void> MonitorSession::until_all_is_written() {
  to_write_.cancel();
  while (!is_written_) co_await written_.async_wait(kAwait);
}

asio::awaitable<void> MonitorSession::write_messages() {
  while (socket_.is_open()) {
    const std::string batch = next_batch();
    if (!batch.empty()) {
      const bool sent = co_await socket_.send(batch);
      if (!sent) break;
      written_.cancel();
    } else if (is_answered_ || client_.has_ended()) {
      break;
    } else {
      co_await to_write_.async_wait(kAwait);
    }
  }
}

std::string MonitorSession::next_batch() {
  std::string batch;
  while (batch.size() < kBatchBytes) {
    const monitor::Message message = client_.next_output();
    if (!message) break;
    batch.append(*message).push_back('\n');
  }
  return batch;
}

// --- HTTP.

asio::awaitable<void> MonitorSession::speak_http(std::string head) {
  socket_.close_after(kMostHttpHead);
  while (!http::is_head_decided(head)) {
    const std::string_view bytes = co_await socket_.read();
    if (bytes.empty()) break;
    head.append(bytes);
  }
  socket_.call_off();
  const auto readiness = context_.is_ready() ? http::Readiness::kReady : http::Readiness::kNotReady;
  const std::string answer = http::answer(head, readiness);
  co_await socket_.send(answer);
  co_await socket_.linger();
}

// --- The end.

void MonitorSession::finish() {
  if (opening_.tongue() == monitor::Tongue::kHttp) return;  // it ends by itself
  if (!is_greeted_) return abort();
  client_.end(monitor::Bye::kShutdown);
  to_write_.cancel();
  socket_.stop_reading();
}

void MonitorSession::abort() {
  silence_.cancel();
  socket_.close();
  to_write_.cancel();
  written_.cancel();
}

}  // namespace xr3
