// WebSocket on a connection of the monitor port, by Boost.Beast: a thin shell around a viewer, one object
// a text message. Its .cpp is one of the two that see Beast.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "server/asio.hpp"
#include "server/monitor_service.hpp"
#include "server/monitor_socket.hpp"

namespace xr3 {

/// How long a silent or stuck client is borne with.
struct WebsocketPatience {
  std::chrono::milliseconds before_ping{15'000};   ///< of silence
  std::chrono::milliseconds before_close{30'000};  ///< of silence, or without taking a byte
};

class Websocket : public std::enable_shared_from_this<Websocket> {
 public:
  /// `service` outlives it.
  static std::shared_ptr<Websocket> make(std::shared_ptr<MonitorSocket> socket,
                                         MonitorService& service, WebsocketPatience patience = {});
  virtual ~Websocket() = default;

  /// Accepts the handshake, whose whole head this is and which was checked, and serves the connection
  /// until it ends.
  virtual asio::awaitable<void> run(std::string head) = 0;

  /// Takes no further request, says `bye`, closes with 1001 and ends.
  virtual void finish() = 0;

  /// Whoever waits looks again: the connection is gone.
  virtual void wake() = 0;

  /// The viewer leaves, once run() is done.
  virtual void retire() = 0;
};

}  // namespace xr3
