// HTTP/1 on a connection of the monitor port: one request after the other, kept alive for a while, until
// one becomes a WebSocket. It knows no resources.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "server/asio.hpp"
#include "server/http_resources.hpp"
#include "server/monitor_socket.hpp"

namespace xr3 {

class HttpSession {
 public:
  /// `to_websocket` serves the connection from a handshake's head on, which was checked.
  using ToWebsocket = std::function<asio::awaitable<void>(std::string head)>;

  /// The socket and the resources outlive it.
  HttpSession(MonitorSocket& socket, HttpResources& resources, ToWebsocket to_websocket)
      : socket_(socket), resources_(resources), to_websocket_(std::move(to_websocket)) {}

  /// Serves what begins with these bytes until the connection ends.
  asio::awaitable<void> run(std::string first_bytes);

  /// Answers what has been asked and ends.
  void finish();

 private:
  asio::awaitable<http::HeadReading> next_head();
  asio::awaitable<http::Answer> answer(const http::HeadReading& head);
  asio::awaitable<bool> is_served(const http::HeadReading& head);
  bool is_handshake(const http::HeadReading& head) const;

  MonitorSocket& socket_;
  HttpResources& resources_;
  ToWebsocket to_websocket_;
  std::string bytes_;  ///< received, and not answered yet
  bool is_finishing_ = false;
};

}  // namespace xr3
