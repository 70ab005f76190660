#include "server/net/listener.hpp"

#include <netinet/tcp.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <algorithm>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/system/system_error.hpp>
#include <cerrno>
#include <chrono>
#include <utility>

#include "server/files/interrupted.hpp"
#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

// Delay after the process has run out of descriptors: some may be closed by then.
constexpr std::chrono::milliseconds kRetryAfter{100};

// Connections accepted in one turn of the event loop, which bounds the wait of other handlers.
constexpr int kConnectionsATurn = 4;

// TCP keepalive: a dead peer is detected 60 s after its last byte.
constexpr int kIdleSeconds = 30;
constexpr int kSecondsBetweenProbes = 10;
constexpr int kProbes = 3;

// Maximum number of unread bytes of a connection that the kernel holds (it counts twice as many,
// for its own needs). By default it would hold up to 4 MiB, outside of --max-memory, and the event
// loop would copy as much for each client that does not read.
constexpr int kSendBuffer = 128 * 1024;

void set_option(tcp::acceptor& acceptor, int level, int name, int value) {
  ::setsockopt(acceptor.native_handle(), level, name, &value, sizeof value);
}

/// Sets the options that connections inherit when they are made (tests/server/net/listener_test.cpp
/// checks it), so that no connection needs a system call for each.
void set_options(tcp::acceptor& acceptor) {
  set_option(acceptor, SOL_SOCKET, SO_KEEPALIVE, 1);
  set_option(acceptor, SOL_SOCKET, SO_SNDBUF, kSendBuffer);
  set_option(acceptor, IPPROTO_TCP, TCP_NODELAY, 1);
  set_option(acceptor, IPPROTO_TCP, TCP_KEEPIDLE, kIdleSeconds);
  set_option(acceptor, IPPROTO_TCP, TCP_KEEPINTVL, kSecondsBetweenProbes);
  set_option(acceptor, IPPROTO_TCP, TCP_KEEPCNT, kProbes);
}

}  // namespace

std::string to_text(const tcp::endpoint& endpoint) {
  const auto address = endpoint.address();
  const std::string host = address.is_v6() ? "[" + address.to_string() + "]" : address.to_string();
  return host + ":" + std::to_string(endpoint.port());
}

asio::ip::address machine_of(const NewConnection& connection) {
  tcp::endpoint local;
  auto size = static_cast<socklen_t>(local.capacity());
  const asio::ip::address peer = connection.peer.address();
  const bool is_known = ::getsockname(connection.descriptor.get(), local.data(), &size) == 0;
  const bool is_this =
      peer == asio::ip::address_v6::loopback() || (is_known && peer == local.address());
  return is_this ? asio::ip::address(asio::ip::address_v4::loopback()) : peer;
}

tcp::socket to_socket(asio::io_context& io, NewConnection connection) {
  tcp::socket socket(io);
  socket.assign(connection.peer.protocol(), connection.descriptor.get());
  connection.descriptor.release();
  socket.non_blocking(true);
  return socket;
}

ErrorCode Listener::listen(const tcp::endpoint& endpoint) {
  ErrorCode error;
  tcp::acceptor acceptor(io_);
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error && endpoint.protocol() == tcp::v6())
    acceptor.set_option(asio::ip::v6_only(true), error);
  if (!error) set_options(acceptor);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  return error ? error : begin(std::move(acceptor));
}

ErrorCode Listener::adopt(int listening) {
  ErrorCode error;
  tcp::acceptor acceptor(io_);
  acceptor.assign(tcp::v4(), listening, error);
  if (!error) set_options(acceptor);
  return error ? error : begin(std::move(acceptor));
}

/// Starts accepting.
ErrorCode Listener::begin(tcp::acceptor acceptor) {
  ErrorCode error;
  acceptor.non_blocking(true, error);
  if (error) return error;
  if (acceptors_.empty()) endpoint_ = acceptor.local_endpoint(error);
  BoundAcceptor& kept =
      acceptors_.emplace_back(BoundAcceptor{std::move(acceptor), asio::steady_timer(io_)});
  spawn_loop(io_.get_executor(), name_, run(kept));
  return error;
}

asio::awaitable<void> Listener::run(BoundAcceptor& bound) {
  auto& [acceptor, retry] = bound;
  while (acceptor.is_open()) {
    const auto [error] = co_await acceptor.async_wait(tcp::acceptor::wait_read, kAwait);
    if (!acceptor.is_open()) co_return;
    if (error) throw boost::system::system_error(error);
    if (!held_ && accept_some(acceptor)) continue;
    if (held_) held_();
    held_ ? retry.expires_at(asio::steady_timer::time_point::max())
          : retry.expires_after(kRetryAfter);
    co_await retry.async_wait(kAwait);
  }
}

void Listener::hold(std::function<void()> waiting) { held_ = std::move(waiting); }

void Listener::release() {
  held_ = nullptr;
  for (BoundAcceptor& bound : acceptors_) bound.retry.cancel();
}

void Listener::accept_pending() {
  if (held_) return;
  for (BoundAcceptor& bound : acceptors_) {
    ErrorCode error;
    while (bound.acceptor.is_open() && !error) error = accept_one(bound.acceptor);
  }
}

bool Listener::accept_some(tcp::acceptor& acceptor) {
  ErrorCode error;
  for (int i = 0; i < kConnectionsATurn && acceptor.is_open() && !error; ++i)
    error = accept_one(acceptor);
  const bool is_done = !error || error == asio::error::would_block ||
                       error == asio::error::try_again || !acceptor.is_open();
  if (!is_done) report_failure(error);
  return is_done;
}

std::string Listener::trouble() const {
  const auto is_open = [](const BoundAcceptor& each) { return each.acceptor.is_open(); };
  if (acceptors_.empty() || !std::ranges::all_of(acceptors_, is_open))
    return std::string(name_) + " is closed";
  return failure_ ? std::string(name_) + " cannot accept a connection: " + failure_.message() : "";
}

void Listener::report_failure(ErrorCode error) {
  ++failures_;
  if (std::exchange(failure_, error)) return;
  spdlog::error("{} cannot accept a connection: {} (reported once until it can)", name_,
                error.message());
}

// Accepts one connection. (Asio's accept() would make the event loop watch the connection: two
// system calls, which a line does not need. It does not return the peer of a connection that is
// lost already.)
ErrorCode Listener::accept_one(tcp::acceptor& acceptor) {
  tcp::endpoint peer;
  auto size = static_cast<socklen_t>(peer.capacity());
  const auto accepted = retry_interrupted([&] {
    return ::accept4(acceptor.native_handle(), peer.data(), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
  });
  if (accepted < 0 && (errno == ECONNABORTED || errno == EPROTO)) return {};  // lost already
  if (accepted < 0) return {errno, boost::system::system_category()};
  peer.resize(size);
  return hand_over({Descriptor(static_cast<int>(accepted)), peer});
}

ErrorCode Listener::hand_over(NewConnection connection) {
  try {
    accepted_(std::move(connection));
  } catch (const boost::system::system_error& failure) {
    return failure.code();
  }
  failure_ = {};
  return {};
}

void Listener::close() {
  ErrorCode ignored;
  for (BoundAcceptor& bound : acceptors_) {
    bound.acceptor.close(ignored);
    bound.retry.cancel();
  }
}

}  // namespace xr3
