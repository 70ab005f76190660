// A session over WebSocket (Boost.Beast): that of a monitor client, each text message of which is
// one JSON object, or that of a Foxglove client. Only the sources of WebSockets and
// server/http/wire.cpp include Beast.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "server/net/asio.hpp"
#include "server/net/socket.hpp"
#include "server/service/service.hpp"
#include "server/session/message_sink.hpp"
#include "server/session/websocket_session.hpp"

namespace xr3 {

/// Time limits for silent or stuck clients.
struct WebsocketPatience {
  std::chrono::milliseconds before_ping{15'000};   ///< silence after which a ping is sent
  std::chrono::milliseconds before_close{30'000};  ///< silence, or time without an accepted byte
};

/// The content of a WebSocket.
struct WebsocketContent {
  std::string_view subprotocol;  ///< one that the client has offered, if it has offered any
  std::size_t max_message;       ///< bytes of a client's message
  /// Makes the session after the handshake. The sink outlives it.
  std::function<std::unique_ptr<WebsocketSession>(MessageSink&)> open;
};

/// A session of the monitor. `service` must outlive it. `cell`: see MonitorSession.
WebsocketContent monitor_content(MonitorService& service, std::optional<std::string> cell = {});

class Websocket : public std::enable_shared_from_this<Websocket> {
 public:
  static std::shared_ptr<Websocket> make(std::shared_ptr<MonitorSocket> socket,
                                         WebsocketContent content, WebsocketPatience patience = {});
  virtual ~Websocket() = default;

  /// Accepts the handshake and serves the connection until it ends. Precondition: `head` is
  /// complete and valid.
  virtual asio::awaitable<void> run(std::string head) = 0;

  /// Accepts no further request, ends the session, and closes with status 1001.
  virtual void finish() = 0;

  /// The bytes of queued messages and of an incomplete request.
  virtual std::size_t held_bytes() const = 0;

  /// Resumes waiting coroutines after the connection was lost.
  virtual void wake() = 0;

  /// Destroys the session. Precondition: the connection is closed.
  virtual void retire() = 0;
};

}  // namespace xr3
