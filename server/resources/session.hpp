// HTTP/1 on a connection of the monitor port: answers one request after the other (keep-alive)
// until the connection closes or is upgraded to WebSocket.
//
// The flow through the folder: a connection of the monitor port whose first bytes look like HTTP
// gets an HttpSession. It reads a head within a time limit, lets server/http parse it, and asks
// HttpResources (resources.hpp) for the answer: first whether Host, Origin, method and target are
// allowed, then the resource by its path, after the cell and the right to read were checked. A
// resource is a cell's state, robot, workcell or pictures, the health or the metrics of the server
// (metrics.hpp, process_stats.hpp), the schema of the messages, a file of the page, which the build
// embeds in the program (web_assets.hpp), or a file of a site, such as the documentation, which the
// worker reads where it is installed (sites.hpp). All are read-only. A valid handshake for /ws or
// /line leaves the session: the connection then belongs to a WebSocket in server/monitor_port.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/net/asio.hpp"
#include "server/net/socket.hpp"
#include "server/resources/resources.hpp"

namespace xr3 {

class HttpSession {
 public:
  /// Serves the connection from a WebSocket handshake on; the head of the handshake is valid.
  using ToWebsocket =
      std::function<asio::awaitable<void>(std::string head, http::HttpRequest request)>;

  /// The socket and the resources must outlive the session.
  HttpSession(MonitorSocket& socket, HttpResources& resources, ToWebsocket to_websocket)
      : socket_(socket), resources_(resources), to_websocket_(std::move(to_websocket)) {}

  /// Serves the connection until it ends. `first_bytes` have been received already.
  asio::awaitable<void> run(std::string first_bytes);

  /// The received bytes, and this session's share of the body that is being sent.
  std::size_t held_bytes() const {
    return bytes_.size() + (sending_ == nullptr ? 0 : sending_->share_bytes());
  }

  /// Answers the current request, then ends.
  void finish();

 private:
  asio::awaitable<http::HeadReading> next_head();
  asio::awaitable<http::Answer> answer(const http::HeadReading& head);
  asio::awaitable<bool> serve(const http::HeadReading& head);
  bool is_handshake(const http::HeadReading& head) const;

  MonitorSocket& socket_;
  HttpResources& resources_;
  ToWebsocket to_websocket_;
  std::string bytes_;  ///< received, not yet answered
  const http::Body* sending_ = nullptr;
  bool is_finishing_ = false;
};

}  // namespace xr3
