// The TCP port of the monitor: accepts connections up to a limit and keeps their sessions.
#pragma once

#include <functional>
#include <memory>
#include <set>

#include "cell/cell.hpp"
#include "server/http/resources.hpp"
#include "server/monitor_port/connection.hpp"
#include "server/monitor_port/refusals.hpp"
#include "server/net/asio.hpp"
#include "server/net/listener.hpp"
#include "server/robot_port/port.hpp"

namespace xr3 {

class MonitorPort {
 public:
  /// Connections beyond are told that it is full, and closed.
  static constexpr std::size_t kMaxConnections = 1024;

  /// `not_ready` is what /readyz asks; `acted` is called after each call on the
  /// cell, and when a connection has ended.
  MonitorPort(asio::io_context& io, Cell& cell, RobotPort& robot_port, const AccessPolicy& policy,
              HttpResources::NotReady not_ready, const std::function<void()>& acted);

  /// Binds; afterwards endpoint() is known and connections are accepted. Returns what went wrong.
  ErrorCode listen(const tcp::endpoint& endpoint);
  tcp::endpoint endpoint() const { return listener_.endpoint(); }

  /// Takes no further connection; sessions finish their request, say `bye` and end.
  void close();
  /// Ends every connection now.
  void abort();
  /// Nothing goes on beside the loop any more: the process ends.
  void stop() { resources_.stop(); }
  bool is_empty() const { return connections_.empty() && refusals_.is_empty(); }

  /// Everybody who watches.
  SubscriberHub& subscribers() { return service_.subscribers(); }

 private:
  using Connections = std::set<std::shared_ptr<MonitorConnection>>;

  void open(tcp::socket socket);
  void refuse(tcp::socket socket);
  void make_room();
  void report_tls();

  MonitorService service_;
  HttpResources resources_;
  MonitorConnectionContext context_;
  Listener listener_;
  Connections connections_;
  Refusals refusals_;
  bool has_logged_tls_ = false;
  bool has_logged_full_ = false;
};

}  // namespace xr3
