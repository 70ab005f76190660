#include "server/monitor_port/session.hpp"

#include <utility>

#include "server/monitor_port/service.hpp"

namespace xr3 {

Viewer::Viewer(MonitorService& service, Carrier& carrier)
    : service_(service),
      client_(service.cells()),
      carrier_(carrier),
      access_(service.first_access()) {
  client_.send(service_.hello(*this));
  service_.add(*this);  // last: if this throws, nobody knows the viewer
}

Viewer::~Viewer() { service_.remove(*this); }

asio::awaitable<void> Viewer::take(std::string_view message) {
  if (const auto error = service_.refuse(*this, message)) {
    client_.send(monitor::result(*error));
  } else if (auto request = client_.take(message)) {
    co_await service_.carry_out(*this, *std::move(request));
  }
  wake();
}

monitor::Message Viewer::next_output() { return client_.next_output(service_.audience().now()); }

void Viewer::prefetch(Depth depth) const {
  if (depth == Depth::kItself) return xr3::prefetch(this);
  if (depth != Depth::kHeld) return carrier_.prefetch(depth);
  xr3::prefetch(&carrier_);
  client_.prefetch([](const auto& followed) { xr3::prefetch(&followed); });
}

void Viewer::end(monitor::Bye why) {
  client_.end(why);
  wake();
}

void Viewer::end(monitor::LineFault fault) {
  client_.end(fault);
  wake();
}

}  // namespace xr3
