#include "server/robot_port/probe.hpp"

#include <array>
#include <boost/asio/buffer.hpp>
#include <memory>
#include <utility>

namespace xr3 {
namespace {

using Clock = std::chrono::steady_clock;

// Inquiry of input lines 1-4: an enabled controller replies with one byte in every profile, and no
// state changes.
constexpr std::string_view kInquiry = "K";

/// The address at which this machine reaches a port that listens on `address`.
asio::ip::address reachable(const asio::ip::address& address) {
  if (!address.is_unspecified()) return address;
  if (address.is_v6()) return asio::ip::address_v6::loopback();
  return asio::ip::address_v4::loopback();
}

/// Opens and binds the socket, so that the robot port can recognize the connection by its endpoint.
ErrorCode open(tcp::socket& socket, const asio::ip::address& address) {
  ErrorCode error;
  const tcp::endpoint any_port(address, 0);
  socket.open(any_port.protocol(), error);
  if (!error) socket.bind(any_port, error);
  if (!error) socket.non_blocking(true, error);
  return error;
}

/// The port no longer expects a probe.
struct Forget {
  void operator()(RobotPort* port) const { port->forget_probe(); }
};

}  // namespace

/// The reply before the connection ended.
struct RobotProbe::Reply {
  ErrorCode refusal;      ///< it was not connected
  std::size_t bytes = 0;  ///< 2: more than one
};

asio::awaitable<std::string> RobotProbe::trouble() {
  co_await asking_.until_free();
  if (Clock::now() < fresh_until_) co_return trouble_;
  const Exclusive::Hold hold(asking_);
  const std::unique_ptr<RobotPort, Forget> expected(&port_);
  is_full_ = false;
  trouble_ = co_await ask();
  fresh_until_ = Clock::now() + kFresh;
  co_return trouble_;
}

asio::awaitable<std::string> RobotProbe::failure() {
  std::string found = co_await trouble();
  if (is_full_) found.clear();
  co_return found;
}

asio::awaitable<std::string> RobotProbe::ask() {
  const auto socket = std::make_shared<tcp::socket>(io_);
  if (const ErrorCode error = open(*socket, reachable(port_.endpoint().address())))
    co_return "the robot port cannot be asked: " + error.message();
  asio::steady_timer deadline(io_);
  run_after(deadline, kPatience, [socket] {
    ErrorCode ignored;
    socket->close(ignored);
  });
  const Reply reply = co_await exchange(*socket);
  if (socket->is_open()) co_return verdict(reply);
  co_return "the robot port does not answer an inquiry within " +
      std::to_string(kPatience.count()) + " ms";
}

asio::awaitable<RobotProbe::Reply> RobotProbe::exchange(tcp::socket& socket) {
  Reply reply;
  const tcp::endpoint port = port_.endpoint();
  port_.expect_probe(socket.local_endpoint(reply.refusal));
  const auto [refusal] =
      co_await socket.async_connect({reachable(port.address()), port.port()}, kAwait);
  reply.refusal = refusal;
  if (refusal) co_return reply;
  ErrorCode lost;
  socket.write_some(asio::buffer(kInquiry), lost);
  socket.shutdown(tcp::socket::shutdown_send, lost);
  std::array<char, 2> bytes{};
  while (reply.bytes < bytes.size()) {
    const auto [end, count] = co_await socket.async_read_some(asio::buffer(bytes), kAwait);
    if (end) break;
    reply.bytes += count;
  }
  co_return reply;
}

std::string RobotProbe::verdict(const Reply& reply) {
  if (reply.refusal) return "the robot port accepts no connection: " + reply.refusal.message();
  const ProbeProgress progress = port_.probe_progress();
  is_full_ = progress == ProbeProgress::kRefused;
  if (is_full_)
    return "every line is in use: " + std::to_string(port_.max_lines()) + " are open (--max-lines)";
  const std::size_t due = progress == ProbeProgress::kIgnored ? 0 : 1;
  if (reply.bytes == due) return {};
  if (reply.bytes == 0) return "the robot port closed a line without an answer to an inquiry";
  return "the robot port answered an inquiry with more than one byte";
}

}  // namespace xr3
