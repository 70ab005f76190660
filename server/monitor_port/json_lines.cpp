#include "server/monitor_port/json_lines.hpp"

#include <array>
#include <boost/asio/post.hpp>
#include <chrono>
#include <utility>

namespace xr3 {
namespace {

constexpr auto kNoProgressDeadline = std::chrono::steady_clock::time_point::max();
// Limits of one write: the number of messages, and the bytes after which no message is added.
constexpr std::size_t kMaxBatch = 16;
constexpr std::size_t kBatchBytes = 64 * 1024;
// Writes in one turn of the event loop: thousands of events may wait for a client.
constexpr int kMaxWrites = 4;
constexpr std::string_view kLineEnd = "\n";

}  // namespace

std::shared_ptr<JsonLines> JsonLines::greet(std::shared_ptr<MonitorSocket> socket,
                                            MonitorService& service,
                                            const asio::ip::address& machine) {
  std::shared_ptr<JsonLines> lines(new JsonLines(std::move(socket)));
  lines->session_ =
      std::make_unique<OpenSession>(service, static_cast<MessageSink&>(*lines), machine);
  lines->pump();
  return lines;
}

JsonLines::JsonLines(std::shared_ptr<MonitorSocket> socket)
    : socket_(std::move(socket)), progress_(socket_->executor(), kNoProgressDeadline) {}

// --- In.

asio::awaitable<void> JsonLines::run(std::string first_bytes, monitor::Protocol protocol) {
  if (protocol == monitor::Protocol::kNotJson) session_->end(monitor::CloseReason::kNotJson);
  lines_.feed(first_bytes);
  bool has_more = !first_bytes.empty();
  while (socket_->is_open()) {
    co_await answer_lines();
    if (session_->client().has_ended() || !has_more) break;
    const std::string_view bytes = co_await socket_->read();
    has_more = !bytes.empty();
    lines_.feed(bytes);
    if (!has_more) lines_.end();
  }
  is_answered_ = true;
  co_await until_all_is_written();
  co_await socket_->linger();
}

/// Handles the buffered requests one after the other, only while the client reads the answers.
/// Yields to the event loop before each one, so that a robot line waits for at most one request.
asio::awaitable<void> JsonLines::answer_lines() {
  for (bool is_first = true; socket_->is_open() && !session_->client().has_ended();
       is_first = false) {
    co_await until_there_is_room();
    if (!socket_->is_open() || session_->client().has_ended()) co_return;
    const auto line = lines_.next();
    if (!line) break;
    if (!is_first) co_await asio::post(socket_->executor(), asio::use_awaitable);
    co_await session_->handle(*line);
  }
  const bool is_over = lines_.fault() != monitor::LineFault::kNone;
  if (is_over && !session_->client().has_ended()) session_->end(lines_.fault());
}

bool JsonLines::is_full() const {
  return session_->client().is_full() || out_bytes_ >= kBatchBytes;
}

asio::awaitable<void> JsonLines::until_there_is_room() {
  while (is_full() && socket_->is_open()) co_await progress_.async_wait(kAwait);
}

// A client that has stopped sending may still have subscriptions.
asio::awaitable<void> JsonLines::until_all_is_written() {
  pump();
  while (!is_done()) co_await progress_.async_wait(kAwait);
}

bool JsonLines::is_done() const {
  if (!socket_->is_open()) return true;
  return out_.empty() && !is_blocked_ && !session_->client().follows_anything();
}

void JsonLines::finish() {
  session_->end(monitor::CloseReason::kShutdown);
  socket_->stop_reading();
  wake();
}

void JsonLines::wake() { progress_.cancel(); }

// --- Out.

void JsonLines::pump() {
  if (is_pumping_ || is_blocked_ || !session_) return;
  is_pumping_ = true;
  int writes = 0;
  for (fill(); !out_.empty() && socket_->is_open() && writes < kMaxWrites; fill(), ++writes) {
    const std::size_t sent = send_some();
    if (sent == 0) break;
    written(sent);
  }
  is_pumping_ = false;
  if (!out_.empty() && socket_->is_open()) writes < kMaxWrites ? wait_for_room() : pump_later();
  progress_.cancel();
}

std::size_t JsonLines::send_some() {
  std::array<asio::const_buffer, 2 * kMaxBatch> buffers;
  std::size_t count = 0;
  std::size_t skipped = written_;
  for (const monitor::Message& message : out_) {
    const std::size_t of_text = std::min(skipped, message->size());
    buffers[count++] = asio::buffer(*message) + of_text;
    skipped = 0;
    buffers[count++] = asio::buffer(kLineEnd);
  }
  return socket_->send_some({buffers.data(), count});
}

void JsonLines::fill() {
  while (out_.size() < kMaxBatch && out_bytes_ < kBatchBytes) {
    monitor::Message message = session_->next_output();
    if (!message) return;
    out_bytes_ += message->size() + kLineEnd.size();
    out_.push_back(std::move(message));
  }
}

void JsonLines::written(std::size_t count) {
  written_ += count;
  out_bytes_ -= count;
  std::size_t sent = 0;
  while (sent < out_.size() && written_ >= out_[sent]->size() + kLineEnd.size()) {
    written_ -= out_[sent]->size() + kLineEnd.size();
    ++sent;
  }
  out_.erase(out_.begin(), out_.begin() + static_cast<std::ptrdiff_t>(sent));
}

void JsonLines::wait_for_room() {
  is_blocked_ = true;
  socket_->when_writable([self = shared_from_this()] { self->pump_again(); });
}

void JsonLines::pump_later() {
  is_blocked_ = true;
  asio::post(socket_->executor(), [self = shared_from_this()] { self->pump_again(); });
}

void JsonLines::pump_again() {
  is_blocked_ = false;
  pump();
}

}  // namespace xr3
