#include "server/monitor_port/refusals.hpp"

#include <chrono>
#include <string>
#include <utility>

#include "protocol/monitor/message.hpp"
#include "protocol/monitor/opening.hpp"
#include "server/http/answer.hpp"
#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

constexpr std::chrono::seconds kSilence{1};

asio::awaitable<void> tell(std::shared_ptr<MonitorSocket> socket) {
  socket->stop_reading_after(kSilence);
  monitor::Opening opening;
  opening.take(co_await socket->read());
  socket->call_off();
  const bool is_http = opening.tongue() == monitor::Tongue::kHttp;
  const std::string words =
      is_http ? http::to_bytes(http::full(), "GET") : *monitor::bye(monitor::Bye::kFull) + "\n";
  if (opening.tongue() != monitor::Tongue::kTls) co_await socket->send(words);
  co_await socket->linger();
}

}  // namespace

void Refusals::add(tcp::socket socket) {
  if (sockets_.size() >= kMost) return;
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
