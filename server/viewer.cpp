#include "server/viewer.hpp"

#include <utility>

#include "server/monitor_service.hpp"

namespace xr3 {

Viewer::Viewer(MonitorService& service, std::function<void()> wake)
    : service_(service),
      client_(service.cells()),
      wake_(std::move(wake)),
      access_(service.first_access()) {
  service_.add(*this);
  client_.send(service_.hello(*this));
}

Viewer::~Viewer() { service_.remove(*this); }

asio::awaitable<void> Viewer::take(std::string_view message) {
  auto request = client_.take(message);
  if (request) co_await service_.carry_out(*this, *std::move(request));
  wake_();
}

monitor::Message Viewer::next_output() { return client_.next_output(service_.audience().now()); }

void Viewer::end(monitor::Bye why) {
  client_.end(why);
  wake_();
}

void Viewer::end(monitor::LineFault fault) {
  client_.end(fault);
  wake_();
}

}  // namespace xr3
