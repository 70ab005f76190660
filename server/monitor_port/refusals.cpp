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

constexpr std::chrono::seconds kSilence{1};

asio::awaitable<void> tell(std::shared_ptr<MonitorSocket> socket) {
  socket->stop_reading_after(kSilence);
  monitor::ProtocolDetector detector;
  detector.feed(co_await socket->read());
  socket->call_off();
  const bool is_http = detector.protocol() == monitor::Protocol::kHttp;
  const std::string words = is_http ? http::to_bytes(http::full(), "GET")
                                    : *monitor::bye(monitor::CloseReason::kFull) + "\n";
  if (detector.protocol() != monitor::Protocol::kTls) co_await socket->send(words);
  co_await socket->linger();
}

}  // namespace

void Refusals::add(tcp::socket socket) {
  if (sockets_.size() >= kMax) return;
  const auto kept = std::make_shared<MonitorSocket>(std::move(socket));
  sockets_.insert(kept);
  spawn_session(kept->executor(), "monitor", tell(kept), [this, kept] {
    kept->close();
    sockets_.erase(kept);
    ended_();
  });
}

void Refusals::abort() {
  for (const auto& socket : sockets_) socket->close();
}

}  // namespace xr3
