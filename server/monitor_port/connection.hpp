// One connection of the monitor port: detects its protocol, then passes it to JSON lines or HTTP. A
// failure in it ends only this connection.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/monitor/protocol_detector.hpp"
#include "server/foxglove/feeds.hpp"
#include "server/monitor_port/json_lines.hpp"
#include "server/monitor_port/line_websocket.hpp"
#include "server/monitor_port/websocket.hpp"
#include "server/net/asio.hpp"
#include "server/net/listener.hpp"
#include "server/net/peer_counts.hpp"
#include "server/net/socket.hpp"
#include "server/resources/session.hpp"
#include "server/service/service.hpp"

namespace xr3 {

class MonitorConnection;

/// Shared by all connections of the port; must outlive them.
struct MonitorConnectionContext {
  MonitorService& service;
  HttpResources& resources;
  FoxgloveFeeds& foxglove;
  MemoryLimit* memory = nullptr;   ///< none if null
  std::function<bool()> has_room;  ///< whether one more descriptor may be open
  std::function<bool(const asio::ip::address&)>
      speaks_http;  ///< whether a machine uses HTTP or WebSocket, or has a short time ago
  std::function<void()> tls_refused;  ///< called when a client speaks TLS
  std::function<void(const std::shared_ptr<MonitorConnection>&)>
      ended;  ///< called at the end; may release the connection
};

class MonitorConnection : public std::enable_shared_from_this<MonitorConnection> {
 public:
  /// Keeps `place`, the client's machine, to its end. Precondition: it is not null.
  MonitorConnection(tcp::socket socket, const tcp::endpoint& peer,
                    MonitorConnectionContext& context, PeerCounts::Place place);

  /// Runs until the connection ends.
  void start();

  /// Accepts no further request, sends `bye` and ends.
  void finish();

  /// The number of its descriptors: a line over WebSocket has two, and a third at the robot port.
  std::size_t descriptors() const { return line_ && line_->is_open() ? 2 : 1; }

  /// The client has shut down its sending side; the port may close it to make room.
  bool only_listens() const { return lines_ && lines_->only_listens(); }

  /// The client has sent HTTP, and perhaps a WebSocket handshake then.
  bool speaks_http() const { return http_.has_value(); }

  /// Ends the connection now.
  void abort();

  /// The bytes that wait for the client to read, or to complete its request.
  std::size_t held_bytes() const;
  const asio::ip::address& machine() const { return *place_; }  ///< see machine_of()
  std::string peer() const { return to_text(peer_); }

 private:
  asio::awaitable<void> run();
  asio::awaitable<std::string> open();
  void greet_after_silence();
  void greet();
  asio::awaitable<void> serve_websocket(std::string head, http::HttpRequest request);
  asio::awaitable<void> serve_foxglove(std::string head, http::HttpRequest request);

  MonitorConnectionContext& context_;
  tcp::endpoint peer_;
  PeerCounts::Place place_;
  std::shared_ptr<MonitorSocket> socket_;
  monitor::ProtocolDetector detector_;
  asio::steady_timer silence_;
  std::shared_ptr<JsonLines> lines_;      ///< once `hello` is sent
  std::optional<HttpSession> http_;       ///< if the client speaks HTTP
  std::shared_ptr<Websocket> websocket_;  ///< if the client requests a session over WebSocket
  std::shared_ptr<LineWebsocket> line_;   ///< if the client requests a line over WebSocket
};

}  // namespace xr3
