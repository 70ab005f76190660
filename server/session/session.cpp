#include "server/session/session.hpp"

#include <algorithm>

#include "server/session/subscribers.hpp"

namespace xr3 {

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
