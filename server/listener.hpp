// Accepts TCP connections: by itself as they come, or all pending ones at once when asked.
#pragma once

#include <functional>

#include "server/asio.hpp"

namespace xr3 {

class Listener {
 public:
  using Accepted = std::function<void(tcp::socket)>;

  /// `accepted` is called with each new connection, non-blocking and with TCP_NODELAY set.
  Listener(asio::io_context& io, Accepted accepted)
      : acceptor_(io), retry_(io), accepted_(std::move(accepted)) {}

  /// Binds and starts to accept. Returns what went wrong; nothing is open then.
  ErrorCode listen(const tcp::endpoint& endpoint);
  tcp::endpoint endpoint() const { return endpoint_; }

  /// Takes every connection that waits in the kernel.
  void accept_pending();
  void close();

 private:
  asio::awaitable<void> run();
  ErrorCode accept_one();

  tcp::acceptor acceptor_;
  asio::steady_timer retry_;
  Accepted accepted_;
  tcp::endpoint endpoint_;
};

}  // namespace xr3
