// A monitor session over WebSocket (Boost.Beast): each text message is one JSON object. Only the
// sources of WebSockets and server/http/wire.cpp include Beast.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "server/net/asio.hpp"
#include "server/net/socket.hpp"
#include "server/service/service.hpp"

namespace xr3 {

/// Time limits for silent or stuck clients.
struct WebsocketPatience {
  std::chrono::milliseconds before_ping{15'000};   ///< silence after which a ping is sent
  std::chrono::milliseconds before_close{30'000};  ///< silence, or time without an accepted byte
};

class Websocket : public std::enable_shared_from_this<Websocket> {
 public:
  /// `service` must outlive the session. `machine`, `cell`: see MonitorSession.
  static std::shared_ptr<Websocket> make(std::shared_ptr<MonitorSocket> socket,
                                         const asio::ip::address& machine, MonitorService& service,
                                         std::optional<std::string> cell = std::nullopt,
                                         WebsocketPatience patience = {});
  virtual ~Websocket() = default;

  /// Accepts the handshake and serves the connection until it ends. Precondition: `head` is
  /// complete and valid.
  virtual asio::awaitable<void> run(std::string head) = 0;

  /// Accepts no further request, sends `bye`, closes with status 1001 and ends.
  virtual void finish() = 0;

  /// The bytes of queued messages and of an incomplete request.
  virtual std::size_t held_bytes() const = 0;

  /// Resumes waiting coroutines after the connection was lost.
  virtual void wake() = 0;

  /// Destroys the monitor session. Precondition: the connection is closed.
  virtual void retire() = 0;
};

}  // namespace xr3
