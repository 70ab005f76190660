// One connection of the monitor port: finds out what it speaks, then hands it to JSON lines or HTTP.
// Ends with its connection; a failure in it ends nothing else.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/monitor/protocol_detector.hpp"
#include "server/http/session.hpp"
#include "server/monitor_port/json_lines.hpp"
#include "server/monitor_port/service.hpp"
#include "server/monitor_port/websocket.hpp"
#include "server/net/asio.hpp"
#include "server/net/socket.hpp"

namespace xr3 {

class MonitorConnection;

/// What all sessions of the port share. It outlives them while they run.
struct MonitorConnectionContext {
  MonitorService& service;
  HttpResources& resources;
  std::function<void()> tls_refused;  ///< a client spoke TLS
  std::function<void(const std::shared_ptr<MonitorConnection>&)>
      ended;  ///< the session may be dropped
};

class MonitorConnection : public std::enable_shared_from_this<MonitorConnection> {
 public:
  MonitorConnection(tcp::socket socket, MonitorConnectionContext& context);

  /// Runs until the connection ends.
  void start();

  /// Takes no further request, says `bye` and ends.
  void finish();

  /// The client has stopped sending, and is not waited for where others want in.
  bool only_listens() const { return lines_ && lines_->only_listens(); }

  /// Ends the connection now.
  void abort();

 private:
  asio::awaitable<void> run();
  asio::awaitable<std::string> open();
  void greet_after_silence();
  void greet();
  asio::awaitable<void> speak(std::string first_bytes);
  asio::awaitable<void> speak_http(std::string first_bytes);
  asio::awaitable<void> speak_websocket(std::string head);

  MonitorConnectionContext& context_;
  std::shared_ptr<MonitorSocket> socket_;
  monitor::ProtocolDetector detector_;
  asio::steady_timer silence_;
  std::shared_ptr<JsonLines> lines_;      ///< once it has been greeted
  std::optional<HttpSession> http_;       ///< once it has spoken HTTP
  std::shared_ptr<Websocket> websocket_;  ///< once it has asked for that
};

}  // namespace xr3
