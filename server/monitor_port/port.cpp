#include "server/monitor_port/port.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace xr3 {

MonitorPort::MonitorPort(asio::io_context& io, Cell& cell, RobotPort& robot_port,
                         const AccessPolicy& policy, HttpResources::NotReady not_ready,
                         const std::function<void()>& acted)
    : service_(io, cell, robot_port, policy, acted),
      resources_(cell, service_, policy, std::move(not_ready)),
      context_{service_, resources_, [this] { tell_of_tls(); },
               [this, acted](const std::shared_ptr<MonitorSession>& session) {
                 sessions_.erase(session);
                 has_told_of_full_ = false;
                 acted();
               }},
      listener_(io, "the monitor port", [this](tcp::socket socket) { open(std::move(socket)); }),
      refusals_(acted) {}

ErrorCode MonitorPort::listen(const tcp::endpoint& endpoint) { return listener_.listen(endpoint); }

void MonitorPort::open(tcp::socket socket) {
  if (sessions_.size() >= kMostMonitors) make_room();
  if (sessions_.size() >= kMostMonitors) return refuse(std::move(socket));
  const auto session = std::make_shared<MonitorSession>(std::move(socket), context_);
  sessions_.insert(session);
  session->start();
}

// Who has closed without a word looks like one who only listens, until something is sent.
void MonitorPort::make_room() {
  const auto idle = std::find_if(sessions_.begin(), sessions_.end(),
                                 [](const auto& session) { return session->only_listens(); });
  if (idle == sessions_.end()) return;
  const auto taken = sessions_.extract(idle);
  taken.value()->abort();
}

void MonitorPort::refuse(tcp::socket socket) {
  if (!std::exchange(has_told_of_full_, true)) {
    spdlog::warn("monitor: connections are refused: {} are open already (told once until one ends)",
                 sessions_.size());
  }
  refusals_.add(std::move(socket));
}

void MonitorPort::tell_of_tls() {
  if (std::exchange(has_told_of_tls_, true)) return;
  spdlog::warn(
      "monitor: a client spoke TLS and was closed; this port speaks plain JSON lines and HTTP "
      "(told once)");
}

// Copies of the set: a session that ends takes itself out of it.
void MonitorPort::close() {
  listener_.close();
  for (const auto& session : Sessions(sessions_)) session->finish();
  refusals_.abort();
}

void MonitorPort::abort() {
  for (const auto& session : Sessions(sessions_)) session->abort();
  refusals_.abort();
}

}  // namespace xr3
