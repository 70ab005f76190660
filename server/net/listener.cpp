#include "server/net/listener.hpp"

#include <boost/asio/ip/v6_only.hpp>
#include <boost/system/system_error.hpp>
#include <chrono>
#include <utility>

#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

// Delay after the process has run out of descriptors: some may be closed by then.
constexpr std::chrono::milliseconds kRetryAfter{100};

}  // namespace

std::string to_text(const tcp::endpoint& endpoint) {
  const auto address = endpoint.address();
  const std::string host = address.is_v6() ? "[" + address.to_string() + "]" : address.to_string();
  return host + ":" + std::to_string(endpoint.port());
}

ErrorCode Listener::listen(const tcp::endpoint& endpoint) {
  ErrorCode error;
  tcp::acceptor acceptor(io_);
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error && endpoint.protocol() == tcp::v6())
    acceptor.set_option(asio::ip::v6_only(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (!error) acceptor.non_blocking(true, error);
  if (error) return error;
  if (acceptors_.empty()) endpoint_ = acceptor.local_endpoint(error);
  tcp::acceptor& kept = acceptors_.emplace_back(std::move(acceptor));
  spawn_loop(io_.get_executor(), name_, run(kept));
  return error;
}

asio::awaitable<void> Listener::run(tcp::acceptor& acceptor) {
  while (acceptor.is_open()) {
    const auto [error] = co_await acceptor.async_wait(tcp::acceptor::wait_read, kAwait);
    if (!acceptor.is_open()) co_return;
    if (error) throw boost::system::system_error(error);
    accept_pending(acceptor);
  }
}

void Listener::accept_pending() {
  for (tcp::acceptor& acceptor : acceptors_) accept_pending(acceptor);
}

void Listener::accept_pending(tcp::acceptor& acceptor) {
  ErrorCode error;
  while (acceptor.is_open() && !error) error = accept_one(acceptor);
  if (error == asio::error::would_block || error == asio::error::try_again || !acceptor.is_open())
    return;
  retry_.expires_after(kRetryAfter);
  retry_.async_wait([this](ErrorCode cancelled) {
    if (!cancelled) accept_pending();
  });
}

ErrorCode Listener::accept_one(tcp::acceptor& acceptor) {
  ErrorCode error;
  tcp::socket socket(io_);
  acceptor.accept(socket, error);
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
  for (tcp::acceptor& acceptor : acceptors_) acceptor.close(ignored);
  retry_.cancel();
}

}  // namespace xr3
