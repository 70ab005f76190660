// The TCP port of the monitor: accepts connections up to a limit and owns them.
//
// The flow through the folder: the port makes a MonitorConnection (connection.hpp) of each accepted
// socket, as long as the limits of all clients and of one address allow; a connection beyond them
// goes to Refusals (refusals.hpp), which answer only health checks. The first bytes tell the
// protocol. JsonLines (json_lines.hpp) splits lines into requests; HTTP goes to the session in
// server/resources, and after a handshake to Websocket (websocket.hpp), or to LineWebsocket
// (line_websocket.hpp), which carries a serial line to the robot port. JsonLines and Websocket are
// transports: each reads one request, has its OpenSession (server/service), or its FoxgloveSession
// (server/foxglove), carry it out, and writes
// the answers and frames that the session queues, as fast as the client reads. While the client
// does not read, requests are not read either. Above --max-memory the port closes the connection
// that holds the most unread bytes.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "server/cells/registry.hpp"
#include "server/monitor_port/connection.hpp"
#include "server/monitor_port/recent_machines.hpp"
#include "server/monitor_port/refusals.hpp"
#include "server/net/asio.hpp"
#include "server/net/listener.hpp"
#include "server/net/socket_limits.hpp"
#include "server/net/wall_clock.hpp"
#include "server/resources/resources.hpp"

namespace xr3 {

class MonitorPort {
 public:
  /// `not_ready` is called for /readyz; `ended` when a connection has ended. Connections beyond the
  /// limit can only ask for /healthz and /readyz. The references must outlive the port.
  MonitorPort(asio::io_context& io, CellRegistry& cells, Worker& worker, const AccessPolicy& policy,
              HttpResources::NotReady not_ready, const std::function<void()>& ended,
              const SocketLimits& limits);

  MonitorService& service() { return service_; }

  /// Binds and starts to accept; endpoint() is then valid. Returns the error.
  ErrorCode listen(const tcp::endpoint& endpoint) { return listener_.listen(endpoint); }
  tcp::endpoint endpoint() const { return listener_.endpoint(); }

  /// Accepts no further connection; sessions finish their request, send `bye` and end. HTTP
  /// requests after the deadline get an error.
  void close(WallNs deadline = kNever);
  /// Closes every connection now.
  void abort();
  bool is_empty() const { return connections_.empty() && refusals_.is_empty(); }

  /// Counts the connections towards a limit of memory, which must outlive the port.
  void limit_memory(MemoryLimit& limit) {
    context_.memory = &limit;
    service_.calls().limit_memory(limit);
  }
  /// The most bytes that one connection holds.
  std::size_t most_held() const;
  /// Closes the connection that holds the most bytes. Precondition: most_held() > 0.
  void close_greediest();

 private:
  /// In the order in which they were opened.
  using Connections = std::vector<std::shared_ptr<MonitorConnection>>;

  void open(NewConnection accepted);
  void refuse(NewConnection accepted);
  CellCounters counters() const;
  std::size_t descriptors() const;
  bool has_room() const { return descriptors() < max_connections_; }
  bool speaks_http(const asio::ip::address& machine) const;
  void make_room();
  std::shared_ptr<MonitorConnection> greediest() const;
  void report_tls();

  asio::io_context& io_;
  std::size_t max_connections_;
  PeerCounts peers_;
  MonitorService service_;
  HttpResources resources_;
  FoxgloveFeeds foxglove_;
  MonitorConnectionContext context_;
  Listener listener_;
  Connections connections_;
  RecentMachines recent_http_;
  Refusals refusals_;
  bool has_logged_tls_ = false;
  bool has_logged_full_ = false;
  std::uint64_t refused_ = 0;
};

}  // namespace xr3
