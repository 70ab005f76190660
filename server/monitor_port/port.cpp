#include "server/monitor_port/port.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace xr3 {

MonitorPort::MonitorPort(asio::io_context& io, Cell& cell, LineTransports& lines,
                         const AccessPolicy& policy, HttpResources::NotReady not_ready,
                         const std::function<void()>& acted, const SocketLimits& limits)
    : max_connections_(limits.connections),
      service_(io, cell, lines, policy, acted),
      resources_(cell, service_, policy, std::move(not_ready)),
      context_{service_, resources_, [this] { report_tls(); },
               [this, acted](const std::shared_ptr<MonitorConnection>& connection) {
                 connections_.erase(connection);
                 has_logged_full_ = false;
                 acted();
               }},
      listener_(io, "the monitor port", [this](tcp::socket socket) { open(std::move(socket)); }),
      refusals_(resources_, limits.refusals, acted) {}

ErrorCode MonitorPort::listen(const tcp::endpoint& endpoint) { return listener_.listen(endpoint); }

void MonitorPort::open(tcp::socket socket) {
  if (connections_.size() >= max_connections_) make_room();
  if (connections_.size() >= max_connections_) return refuse(std::move(socket));
  const auto connection = std::make_shared<MonitorConnection>(std::move(socket), context_);
  connections_.insert(connection);
  connection->start();
}

// A client that has closed its connection looks like one that only listens, until a write fails.
void MonitorPort::make_room() {
  const auto idle = std::find_if(connections_.begin(), connections_.end(),
                                 [](const auto& connection) { return connection->only_listens(); });
  if (idle == connections_.end()) return;
  const auto taken = connections_.extract(idle);
  taken.value()->abort();
}

void MonitorPort::refuse(tcp::socket socket) {
  if (!std::exchange(has_logged_full_, true)) {
    spdlog::warn(
        "monitor: connections are refused: {} are open already (reported once until one ends)",
        connections_.size());
  }
  refusals_.add(std::move(socket));
}

void MonitorPort::report_tls() {
  if (std::exchange(has_logged_tls_, true)) return;
  spdlog::warn(
      "monitor: a client sent TLS and was disconnected; this port accepts only JSON lines and HTTP "
      "(reported once)");
}

// Copies of the set: a connection that ends removes itself from it.
void MonitorPort::close(WallNs deadline) {
  listener_.close();
  resources_.close_at(deadline);
  for (const auto& connection : Connections(connections_)) connection->finish();
  refusals_.abort();
}

void MonitorPort::abort() {
  for (const auto& connection : Connections(connections_)) connection->abort();
  refusals_.abort();
}

}  // namespace xr3
