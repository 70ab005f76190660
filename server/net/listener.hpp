// Accepts TCP connections: as they arrive, or all pending ones on request.
#pragma once

#include <functional>
#include <list>
#include <string>

#include "server/net/asio.hpp"

namespace xr3 {

/// Address and port as text: `127.0.0.1:9600`, `[::1]:9600`.
std::string to_text(const tcp::endpoint& endpoint);

class Listener {
 public:
  using Accepted = std::function<void(tcp::socket)>;

  /// `accepted` is called with each new connection, non-blocking and with TCP_NODELAY set.
  /// `name` is a literal, for the log.
  Listener(asio::io_context& io, const char* name, Accepted accepted)
      : io_(io), name_(name), retry_(io), accepted_(std::move(accepted)) {}

  /// Binds and starts to accept, in addition to the endpoints that are already open. Returns the
  /// error; the endpoint is then not open.
  ErrorCode listen(const tcp::endpoint& endpoint);
  /// The first endpoint that was opened.
  tcp::endpoint endpoint() const { return endpoint_; }

  /// Accepts every connection that is pending in the kernel.
  void accept_pending();
  void close();

 private:
  asio::awaitable<void> run(tcp::acceptor& acceptor);
  void accept_pending(tcp::acceptor& acceptor);
  ErrorCode accept_one(tcp::acceptor& acceptor);

  asio::io_context& io_;
  const char* name_;
  std::list<tcp::acceptor> acceptors_;
  asio::steady_timer retry_;
  Accepted accepted_;
  tcp::endpoint endpoint_;
};

}  // namespace xr3
