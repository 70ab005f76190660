#include "server/monitor_port/session.hpp"

#include <algorithm>
#include <utility>

#include "server/monitor_port/service.hpp"

namespace xr3 {

MonitorSession::MonitorSession(MonitorService& service, MessageSink& sink,
                               std::optional<std::string> chosen)
    : service_(service),
      sink_(sink),
      access_(service.sessions().first_access()),
      chosen_cell_(std::move(chosen)) {
  client_.send(service_.sessions().hello(*this));
  service_.sessions().add(*this);  // last: if anything throws, the session is not registered
}

// NOLINTNEXTLINE(bugprone-exception-escape): remove() throws only without memory for its caller
MonitorSession::~MonitorSession() { service_.sessions().remove(*this); }

asio::awaitable<void> MonitorSession::handle(std::string_view message) {
  if (auto refusal = service_.refuse(*this, message)) {
    client_.send(std::move(refusal));
  } else if (auto request = client_.accept(co_await service_.read(message))) {
    co_await service_.carry_out(*this, *std::move(request));
  }
  wake();
}

monitor::Message MonitorSession::next_output() {
  return client_.next_output(SubscriberHub::wall_frame());
}

bool MonitorSession::join(SubscriberHub& hub) {
  if (std::ranges::find(hubs_, &hub) != hubs_.end()) return false;
  hubs_.push_back(&hub);
  return true;
}

void MonitorSession::leave(SubscriberHub& hub) { std::erase(hubs_, &hub); }

void MonitorSession::end(monitor::CloseReason why) {
  client_.end(why);
  wake();
}

void MonitorSession::end(monitor::LineFault fault) {
  client_.end(fault);
  wake();
}

}  // namespace xr3
