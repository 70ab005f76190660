#include "server/monitor_port/port.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

namespace xr3 {

MonitorPort::MonitorPort(asio::io_context& io, CellRegistry& cells, Worker& worker,
                         const AccessPolicy& policy, HttpResources::NotReady not_ready,
                         const std::function<void()>& ended, const SocketLimits& limits)
    : io_(io),
      max_connections_(limits.connections),
      peers_(peer_counts(limits.per_address, limits.connections - limits.connections / 4)),
      service_(io, cells, worker, policy),
      resources_(service_, policy, std::move(not_ready), [this] { return counters(); }),
      foxglove_(io),
      context_{service_,
               resources_,
               foxglove_,
               nullptr,
               [this] { return has_room(); },
               [this](const asio::ip::address& machine) { return speaks_http(machine); },
               [this] { report_tls(); },
               [this, ended](const std::shared_ptr<MonitorConnection>& connection) {
                 if (connection->speaks_http())
                   recent_http_.note(connection->machine(), std::chrono::steady_clock::now());
                 std::erase(connections_, connection);
                 has_logged_full_ = false;
                 ended();
               }},
      listener_(io, "the monitor port",
                [this](NewConnection connection) { open(std::move(connection)); }),
      refusals_(resources_, limits.refusals, ended) {}

void MonitorPort::open(NewConnection accepted) {
  if (!has_room()) make_room();
  if (!has_room()) return refuse(std::move(accepted));
  auto place = peers_.take(machine_of(accepted));
  if (!place) return refuse(std::move(accepted));
  const tcp::endpoint peer = accepted.peer;
  const auto connection = std::make_shared<MonitorConnection>(to_socket(io_, std::move(accepted)),
                                                              peer, context_, std::move(place));
  connections_.push_back(connection);
  connection->start();
}

std::size_t MonitorPort::descriptors() const {
  std::size_t count = 0;
  for (const auto& connection : connections_) count += connection->descriptors();
  return count;
}

bool MonitorPort::speaks_http(const asio::ip::address& machine) const {
  const bool is_open = std::ranges::any_of(connections_, [&](const auto& each) {
    return each->speaks_http() && each->machine() == machine;
  });
  return is_open || recent_http_.contains(machine, std::chrono::steady_clock::now());
}

// A client that has closed its connection looks like one that only listens, until a write fails.
void MonitorPort::make_room() {
  const auto idle = std::ranges::find_if(
      connections_, [](const auto& connection) { return connection->only_listens(); });
  if (idle == connections_.end()) return;
  const auto taken = *idle;
  connections_.erase(idle);
  taken->abort();
}

void MonitorPort::refuse(NewConnection accepted) {
  ++refused_;
  if (!std::exchange(has_logged_full_, true)) {
    spdlog::warn(
        "monitor: connections are refused: {} are open already, or as many as one address may have "
        "(--max-per-address; reported once until one ends)",
        connections_.size());
  }
  refusals_.add(to_socket(io_, std::move(accepted)));
}

std::shared_ptr<MonitorConnection> MonitorPort::greediest() const {
  const auto most = std::ranges::max_element(connections_, {},
                                             [](const auto& each) { return each->held_bytes(); });
  return most == connections_.end() ? nullptr : *most;
}

std::size_t MonitorPort::most_held() const {
  const auto connection = greediest();
  return connection ? connection->held_bytes() : 0;
}

void MonitorPort::close_greediest() {
  assert(most_held() > 0);
  const auto connection = greediest();
  spdlog::warn(
      "monitor: the connection of {} is closed: the server needs more memory than --max-memory, "
      "and this client has the most unread answers ({} bytes)",
      connection->peer(), connection->held_bytes());
  connection->abort();
}

CellCounters MonitorPort::counters() const {
  CellCounters counters = service_.counters();
  counters.monitor_port = {refused_, listener_.failures()};
  return counters;
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
  service_.stop();
  for (const auto& connection : Connections(connections_)) connection->finish();
  refusals_.abort();
}

void MonitorPort::abort() {
  for (const auto& connection : Connections(connections_)) connection->abort();
  refusals_.abort();
}

}  // namespace xr3
