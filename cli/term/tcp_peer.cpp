#include "cli/term/tcp_peer.hpp"

#include <boost/asio/connect.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <filesystem>
#include <utility>

#include "server/base/exit_code.hpp"
#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

constexpr std::chrono::seconds kMaxConnecting{5};
constexpr std::chrono::milliseconds kBreakTime{300};

/// The result of connecting: the peer, or the reason why there is none.
struct Connecting {
  std::unique_ptr<TcpPeer> peer;
  std::string trouble;
};

std::string refusal(const TermOptions& options, const ErrorCode& error) {
  if (error != asio::error::connection_refused) {
    return "cannot connect to " + options.peer + " (" + error.message() + ")";
  }
  return "nothing listens at " + options.peer + "; xr3 serve starts a simulated robot";
}

std::string unknown_host(const std::string& host) {
  std::error_code ignored;
  const bool is_file = std::filesystem::exists(host, ignored);
  return "no address is known for " + host + (is_file ? "; a path begins with / or ./" : "");
}

std::optional<TelnetClient> telnet_for(const TermOptions& options) {
  if (!options.is_rfc2217) return std::nullopt;
  return TelnetClient(options.settings);
}

asio::awaitable<void> connect(asio::io_context& context, const TermOptions& options,
                              Connecting& result) {
  tcp::resolver resolver(context);
  const auto [unknown, places] =
      co_await resolver.async_resolve(options.address.host, options.address.port, kAwait);
  if (unknown) {
    result.trouble = unknown_host(options.address.host);
    co_return;
  }
  tcp::socket socket(context);
  const auto [refused, place] = co_await asio::async_connect(socket, places, kAwait);
  if (refused) {
    result.trouble = refusal(options, refused);
    co_return;
  }
  ErrorCode ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  auto peer = std::make_unique<TcpPeer>(std::move(socket), telnet_for(options));
  const bool is_connected = co_await peer->negotiate();
  if (is_connected) {
    result.peer = std::move(peer);
  } else {
    result.trouble = options.peer + " has closed the connection";
  }
}

}  // namespace

asio::awaitable<bool> TcpPeer::negotiate() {
  if (!telnet_) co_return true;
  protocol_bytes_ = telnet_->opening();
  while (!telnet_->is_settled()) {
    const bool is_sent = co_await write({});
    if (!is_sent) co_return false;
    const auto [error, size] = co_await socket_.async_read_some(asio::buffer(buffer_), kAwait);
    if (error) co_return false;
    filter({buffer_.data(), size});
    early_data_ += std::exchange(data_, {});
  }
  co_return true;
}

void TcpPeer::filter(std::string_view bytes) {
  for (const char byte : bytes) {
    const auto data = telnet_->feed(static_cast<std::uint8_t>(byte), protocol_bytes_);
    if (data) data_.push_back(static_cast<char>(*data));
  }
}

asio::awaitable<std::string_view> TcpPeer::read() {
  data_ = std::exchange(early_data_, {});
  while (data_.empty()) {
    const auto [error, size] = co_await socket_.async_read_some(asio::buffer(buffer_), kAwait);
    if (error) co_return std::string_view{};
    if (!telnet_) co_return std::string_view(buffer_.data(), size);
    filter({buffer_.data(), size});
    if (due_) due_();
  }
  co_return std::string_view(data_);
}

asio::awaitable<bool> TcpPeer::write(std::string_view data) {
  std::string bytes = std::exchange(protocol_bytes_, {});
  if (telnet_) {
    TelnetClient::encode(data, bytes);
  } else {
    bytes += data;
  }
  if (bytes.empty()) co_return true;
  const auto [error, size] = co_await asio::async_write(socket_, asio::buffer(bytes), kAwait);
  co_return !error;
}

asio::awaitable<std::string> TcpPeer::send_break() {
  if (!telnet_) co_return "not possible here: a TCP connection has no break; try --rfc2217";
  if (!telnet_->has_com_port()) {
    co_return "not possible here: the peer has refused COM-PORT (RFC 2217)";
  }
  telnet_->append_break(true, protocol_bytes_);
  const bool has_begun = co_await write({});
  asio::steady_timer timer(socket_.get_executor(), kBreakTime);
  co_await timer.async_wait(kAwait);
  telnet_->append_break(false, protocol_bytes_);
  const bool has_ended = co_await write({});
  co_return has_begun&& has_ended ? std::string{} : "not sent: the connection is lost";
}

bool TcpPeer::finish() {
  ErrorCode ignored;
  socket_.shutdown(tcp::socket::shutdown_send, ignored);
  return true;
}

std::unique_ptr<TcpPeer> connect_peer(asio::io_context& context, const TermOptions& options) {
  Connecting result;
  spawn_loop(context.get_executor(), "term", connect(context, options, result));
  context.run_for(kMaxConnecting);
  if (!result.peer) {
    const bool is_late = result.trouble.empty();
    throw ExitError(ExitCode::kNoServer,
                    is_late ? options.peer + " does not answer" : result.trouble);
  }
  context.restart();
  return std::move(result.peer);
}

}  // namespace xr3
