#include "server/monitor_port/refusals.hpp"

#include <chrono>
#include <string>
#include <utility>

#include "protocol/monitor/message.hpp"
#include "protocol/monitor/protocol_detector.hpp"
#include "server/http/answer.hpp"
#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

constexpr std::chrono::seconds kTimeout{1};

/// Reads the rest of a request's head; incomplete if it does not arrive in time. Parses it once.
asio::awaitable<http::HeadReading> read_head(MonitorSocket& socket, std::string bytes) {
  while (bytes.find("\r\n\r\n") == std::string::npos && bytes.size() < http::kMaxHeadBytes) {
    const std::string_view more = co_await socket.read();
    if (more.empty()) break;
    bytes.append(more);
  }
  co_return http::read_head(bytes);
}

asio::awaitable<std::string> http_answer(MonitorSocket& socket, std::string bytes,
                                         HttpResources& resources) {
  const http::HeadReading head = co_await read_head(socket, std::move(bytes));
  const bool is_served = head.fault == http::HeadFault::kNone &&
                         HttpResources::is_health_check(head.request) &&
                         !resources.refuse(head.request);
  if (!is_served) co_return http::to_bytes(http::full(), "GET");
  http::Answer answer = co_await resources.answer(head.request);
  co_return http::to_bytes(http::closing(std::move(answer)), head.request.method);
}

asio::awaitable<void> refuse(std::shared_ptr<MonitorSocket> socket, HttpResources& resources) {
  socket->stop_reading_after(kTimeout);
  monitor::ProtocolDetector detector;
  std::string_view bytes = co_await socket->read();
  bytes.remove_prefix(detector.feed(bytes));
  std::string reply;
  if (detector.protocol() == monitor::Protocol::kHttp) {
    reply = co_await http_answer(*socket, std::string(bytes), resources);
  } else if (detector.protocol() != monitor::Protocol::kTls) {
    reply = *monitor::bye(monitor::CloseReason::kFull) + "\n";
  }
  socket->call_off();
  co_await socket->send(reply);
  co_await socket->linger();
}

}  // namespace

void Refusals::add(tcp::socket socket) {
  if (sockets_.size() >= max_) {  // a silent client must not keep a health check out
    sockets_.front()->close();
    sockets_.pop_front();
  }
  const auto kept = std::make_shared<MonitorSocket>(std::move(socket));
  sockets_.push_back(kept);
  spawn_session(kept->executor(), "monitor", refuse(kept, resources_), [this, kept] {
    kept->close();
    sockets_.remove(kept);
    ended_();
  });
}

void Refusals::abort() {
  for (const auto& socket : sockets_) socket->close();
}

}  // namespace xr3
