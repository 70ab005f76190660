#include "server/resources/session.hpp"

#include <boost/asio/post.hpp>
#include <chrono>
#include <utility>

namespace xr3 {
namespace {

constexpr std::chrono::seconds kMaxHeadTime{10};
constexpr std::chrono::seconds kKeptAlive{30};

bool is_websocket(const http::HttpRequest& request) {
  return !http::subprotocols_of(request.path()).empty();
}

/// RFC 9112, section 2.2: empty lines before a request line are ignored.
void skip_line_ends(std::string& bytes) {
  bytes.erase(0, std::min(bytes.find_first_not_of("\r\n"), bytes.size()));
}

/// Parsing an incomplete head again is only useful if new bytes end a line or reach the limit.
bool is_worth_a_look(std::string_view more, std::size_t bytes) {
  return more.find('\n') != std::string_view::npos || bytes >= http::kMaxHeadBytes;
}

}  // namespace

asio::awaitable<void> HttpSession::run(std::string first_bytes) {
  bytes_ = std::move(first_bytes);
  for (bool goes_on = true; goes_on;) {
    const http::HeadReading head = co_await next_head();
    if (!socket_.is_open() || bytes_.empty()) break;
    if (is_handshake(head)) {
      co_await to_websocket_(std::exchange(bytes_, {}), head.request);
      co_return;
    }
    goes_on = co_await serve(head);
    // Yields between requests, so that pipelined requests do not starve other clients.
    co_await asio::post(socket_.executor(), asio::use_awaitable);
  }
  co_await socket_.linger();
}

/// Reads the next head. `bytes_` is empty afterwards if the client sent no further request.
asio::awaitable<http::HeadReading> HttpSession::next_head() {
  http::HeadReading head = http::read_head(bytes_);
  bool has_begun = !bytes_.empty();
  socket_.stop_reading_after(has_begun ? kMaxHeadTime : kKeptAlive);
  while (head.fault == http::HeadFault::kIncomplete) {
    const std::string_view more = co_await socket_.read();
    if (more.empty()) break;
    if (!std::exchange(has_begun, true)) socket_.stop_reading_after(kMaxHeadTime);
    bytes_.append(more);
    skip_line_ends(bytes_);
    if (is_worth_a_look(more, bytes_.size())) head = http::read_head(bytes_);
  }
  socket_.call_off();
  co_return head;
}

asio::awaitable<http::Answer> HttpSession::answer(const http::HeadReading& head) {
  if (head.fault == http::HeadFault::kIncomplete && socket_.has_waited_enough())
    co_return http::too_slow();
  if (auto refused = http::refuse_head(head.fault)) co_return *std::move(refused);
  if (auto refused = resources_.refuse(head.request)) co_return *std::move(refused);
  if (is_websocket(head.request)) {
    if (auto refused = resources_.refuse_websocket(head.request)) co_return *std::move(refused);
    co_return http::bad_request("a WebSocket client must wait for 101 before it sends frames",
                                "send only the head of the handshake");
  }
  co_return co_await resources_.answer(head.request);
}

bool HttpSession::is_handshake(const http::HeadReading& head) const {
  return head.fault == http::HeadFault::kNone && is_websocket(head.request) &&
         bytes_.size() == head.head_bytes && !is_finishing_ && !resources_.refuse(head.request) &&
         !resources_.refuse_websocket(head.request);
}

/// Answers the request. Returns whether the connection stays open for another one.
asio::awaitable<bool> HttpSession::serve(const http::HeadReading& head) {
  http::Answer given = co_await answer(head);
  if (head.request.then == http::Then::kClose || is_finishing_) given.then = http::Then::kClose;
  bytes_.erase(0, head.head_bytes);
  skip_line_ends(bytes_);
  const std::string answer_head = http::head_bytes(given);
  sending_ = &given.body;
  const bool is_sent =
      co_await socket_.send(answer_head, http::body_bytes(given, head.request.method));
  sending_ = nullptr;
  co_return is_sent&& given.then == http::Then::kKeep;
}

void HttpSession::finish() {
  is_finishing_ = true;
  socket_.stop_reading();
}

}  // namespace xr3
