// A serial line over WebSocket, for programs in web pages, which cannot connect to the robot port:
// binary messages in both directions are the bytes of a connection to that port. Only the sources
// of WebSockets and server/http/wire.cpp include Beast.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/net/asio.hpp"
#include "server/net/socket.hpp"
#include "server/service/service.hpp"

namespace xr3 {

class LineWebsocket : public std::enable_shared_from_this<LineWebsocket> {
 public:
  /// `service` must outlive it. `cell`: the first one if nullopt. `peer`: the client's machine (see
  /// machine_of()) and its port. The line is refused unless `has_room` says that one more
  /// descriptor may be open.
  static std::shared_ptr<LineWebsocket> make(std::shared_ptr<MonitorSocket> socket,
                                             const tcp::endpoint& peer, MonitorService& service,
                                             std::optional<std::string> cell,
                                             std::function<bool()> has_room);
  virtual ~LineWebsocket() = default;

  /// Serves the connection until it ends, or its line is closed. Precondition: `head` is the valid
  /// head of a handshake. If calls need a token, the first message is `auth`, as for the monitor.
  virtual asio::awaitable<void> run(std::string head) = 0;

  /// Whether its line is open.
  virtual bool is_open() const = 0;

  /// The bytes that wait for the client to read, or for the line.
  virtual std::size_t held_bytes() const = 0;

  /// Accepts no further client: ends if no line is open yet, else with the line.
  virtual void finish() = 0;

  /// Ends now, also the line.
  virtual void abort() = 0;
};

}  // namespace xr3
