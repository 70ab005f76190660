#include "server/listener.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <chrono>
#include <utility>

namespace xr3 {
namespace {

// When the process has run out of descriptors: long enough for some to be closed.
constexpr std::chrono::milliseconds kRetryAfter{100};

}  // namespace

ErrorCode Listener::listen(const tcp::endpoint& endpoint) {
  ErrorCode error;
  acceptor_.open(endpoint.protocol(), error);
  if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (!error) acceptor_.non_blocking(true, error);
  if (!error) endpoint_ = acceptor_.local_endpoint(error);
  if (error) {
    close();
    return error;
  }
  asio::co_spawn(acceptor_.get_executor(), run(), asio::detached);
  return error;
}

asio::awaitable<void> Listener::run() {
  while (acceptor_.is_open()) {
    const auto [error] = co_await acceptor_.async_wait(tcp::acceptor::wait_read, kAwait);
    if (error || !acceptor_.is_open()) co_return;
    accept_pending();
  }
}

void Listener::accept_pending() {
  ErrorCode error;
  while (acceptor_.is_open() && !error) error = accept_one();
  if (error == asio::error::would_block || error == asio::error::try_again || !acceptor_.is_open())
    return;
  retry_.expires_after(kRetryAfter);
  retry_.async_wait([this](ErrorCode cancelled) {
    if (!cancelled) accept_pending();
  });
}

ErrorCode Listener::accept_one() {
  ErrorCode error;
  tcp::socket socket(acceptor_.get_executor());
  acceptor_.accept(socket, error);
  if (error == asio::error::connection_aborted) return {};
  if (error) return error;
  ErrorCode ignored;
  socket.non_blocking(true, ignored);
  socket.set_option(tcp::no_delay(true), ignored);
  accepted_(std::move(socket));
  return {};
}

void Listener::close() {
  ErrorCode ignored;
  acceptor_.close(ignored);
  retry_.cancel();
}

}  // namespace xr3
