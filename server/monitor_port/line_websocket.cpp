#include "server/monitor_port/line_websocket.hpp"

#include <sys/socket.h>

#include <array>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <cassert>
#include <chrono>
#include <string_view>
#include <utility>
#include <variant>

#include "server/monitor_port/handshake.hpp"
#include "server/net/spawn.hpp"

namespace xr3 {
namespace {

namespace ws = boost::beast::websocket;

constexpr std::chrono::seconds kMaxLineHandshake{10};
constexpr std::chrono::milliseconds kMaxLineCloseTime{500};
constexpr std::size_t kMaxMessage = std::size_t{64} * 1024;

std::string_view bytes_in(const boost::beast::flat_buffer& buffer) {
  return {static_cast<const char*>(buffer.cdata().data()), buffer.size()};
}

/// The token of a request `auth`; empty for any other message.
std::string token_in(std::string_view message) {
  const monitor::RequestReading reading = monitor::read_request(message);
  const auto* request = std::get_if<monitor::Request>(&reading);
  const auto* auth = request == nullptr ? nullptr : std::get_if<monitor::Auth>(&request->what);
  return auth == nullptr ? std::string() : auth->token;
}

/// The line is served like a connection of the robot port: that port gets one end of a pair of
/// sockets, and this object carries bytes between the other end and the client.
class BeastLineWebsocket final : public LineWebsocket {
 public:
  BeastLineWebsocket(std::shared_ptr<MonitorSocket> socket, const tcp::endpoint& peer,
                     MonitorService& service, std::optional<std::string> cell,
                     std::function<bool()> has_room)
      : socket_(std::move(socket)),
        peer_(peer),
        service_(service),
        cell_(std::move(cell)),
        has_room_(std::move(has_room)),
        stream_(socket_->stream()),
        line_(socket_->executor()) {
    stream_.set_option(ws::stream_base::timeout{kMaxLineHandshake, ws::stream_base::none(), false});
    stream_.read_message_max(kMaxMessage);
    stream_.binary(true);
  }

  asio::awaitable<void> run(std::string head) override;
  bool is_open() const override { return line_.is_open(); }
  std::size_t held_bytes() const override { return received_.size() + replies_size_; }
  void finish() override {
    if (!line_.is_open()) abort();
  }
  void abort() override;

 private:
  std::shared_ptr<BeastLineWebsocket> self() {
    return std::static_pointer_cast<BeastLineWebsocket>(shared_from_this());
  }
  asio::awaitable<void> serve();
  asio::awaitable<bool> is_allowed();
  CellPtr find_cell() const;
  asio::awaitable<bool> read();
  void open(RobotPort& port);
  tcp::endpoint machine() const;
  asio::awaitable<void> carry_bytes();
  asio::awaitable<void> carry_replies();
  asio::awaitable<void> close(ws::close_code code, std::string_view why);

  std::shared_ptr<MonitorSocket> socket_;
  tcp::endpoint peer_;
  MonitorService& service_;
  std::optional<std::string> cell_;
  std::function<bool()> has_room_;
  ws::stream<tcp::socket&> stream_;
  asio::local::stream_protocol::socket line_;  ///< the other end of the line
  boost::beast::flat_buffer received_;         ///< bounded by kMaxMessage
  std::array<char, 4096> replies_;
  std::size_t replies_size_ = 0;
  bool is_closing_ = false;
};

asio::awaitable<void> BeastLineWebsocket::run(std::string head) {
  assert(http::read_head(head).fault == http::HeadFault::kNone);
  const bool accepted =
      co_await accept_handshake(stream_, head, http::subprotocols_of(http::kLinePath).front());
  if (accepted && socket_->is_open()) co_await serve();
  abort();
}

asio::awaitable<void> BeastLineWebsocket::serve() {
  const bool allowed = co_await is_allowed();
  if (!socket_->is_open()) co_return;
  if (!allowed)
    co_return co_await close(ws::policy_error, R"(send {"op":"auth","token":"..."} first)");
  const CellPtr at = find_cell();
  if (!at) co_return co_await close(ws::policy_error, "there is no such cell");
  if (at->port() == nullptr)
    co_return co_await close(ws::policy_error, "this cell has no robot port");
  co_await at->be_back();
  if (!socket_->is_open()) co_return;
  if (!has_room_()) co_return co_await close(ws::try_again_later, "too many connections are open");
  open(*at->port());
  spawn_session(socket_->executor(), "line", carry_replies(), [self = self()] { self->abort(); });
  co_await carry_bytes();
}

/// Whether the client may use the line; reads its token if it needs one.
asio::awaitable<bool> BeastLineWebsocket::is_allowed() {
  if (!service_.sessions().needs_token()) co_return true;
  socket_->close_after(kMaxLineHandshake);
  const bool arrived = co_await read();
  socket_->call_off();
  const std::string token =
      arrived && stream_.got_text() ? token_in(bytes_in(received_)) : std::string();
  received_.clear();
  co_return co_await service_.sessions().may_control(cell_, token);
}

CellPtr BeastLineWebsocket::find_cell() const {
  if (cell_) return service_.cells().find(*cell_);
  return service_.cells().is_empty() ? nullptr : service_.cells().all().front();
}

/// Reads a message. False if the connection has ended.
asio::awaitable<bool> BeastLineWebsocket::read() {
  received_.clear();
  const auto [error, count] = co_await stream_.async_read(received_, kAwait);
  socket_->count_bytes(count);
  co_return !error;
}

void BeastLineWebsocket::open(RobotPort& port) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw boost::system::system_error(errno, boost::system::system_category(), "socketpair");
  Descriptor theirs(ends[1]);
  line_.assign(asio::local::stream_protocol(), ends[0]);
  port.open({std::move(theirs), machine()});
}

/// The client, whose address is that of loopback if it is on this machine: see machine_of().
tcp::endpoint BeastLineWebsocket::machine() const {
  ErrorCode lost;
  const auto local = socket_->stream().local_endpoint(lost);
  const bool is_this = !lost && local.address() == peer_.address();
  return {is_this ? asio::ip::address(asio::ip::address_v4::loopback()) : peer_.address(),
          peer_.port()};
}

/// Passes messages to the line, as fast as it takes them, until the client has closed the
/// connection. An empty message ends the input of the line.
asio::awaitable<void> BeastLineWebsocket::carry_bytes() {
  for (bool is_first = true;; is_first = false) {
    const bool arrived = co_await read();
    if (!arrived) co_return;
    if (stream_.got_text() && is_first) continue;  // `auth`, which is not needed
    if (stream_.got_text())
      co_return co_await close(ws::unknown_data, "a line carries binary messages");
    ErrorCode ignored;
    if (received_.size() == 0)
      line_.shutdown(asio::socket_base::shutdown_send, ignored);
    else
      co_await asio::async_write(line_, received_.cdata(), kAwait);
  }
}

/// Passes replies to the client, as fast as it reads them, until the line is closed.
asio::awaitable<void> BeastLineWebsocket::carry_replies() {
  for (;;) {
    const auto [ended, count] = co_await line_.async_read_some(asio::buffer(replies_), kAwait);
    if (ended) break;
    replies_size_ = count;
    const auto [lost, sent] =
        co_await stream_.async_write(asio::buffer(replies_.data(), count), kAwait);
    replies_size_ = 0;
    if (lost) co_return;
  }
  if (socket_->is_open()) co_await close(ws::normal, "the line is closed");
}

asio::awaitable<void> BeastLineWebsocket::close(ws::close_code code, std::string_view why) {
  if (std::exchange(is_closing_, true)) co_return;
  socket_->close_after(kMaxLineCloseTime);
  const ws::close_reason reason(code, why);
  co_await stream_.async_close(reason, kAwait);
}

void BeastLineWebsocket::abort() {
  ErrorCode ignored;
  line_.close(ignored);
  socket_->close();
}

}  // namespace

std::shared_ptr<LineWebsocket> LineWebsocket::make(std::shared_ptr<MonitorSocket> socket,
                                                   const tcp::endpoint& peer,
                                                   MonitorService& service,
                                                   std::optional<std::string> cell,
                                                   std::function<bool()> has_room) {
  return std::make_shared<BeastLineWebsocket>(std::move(socket), peer, service, std::move(cell),
                                              std::move(has_room));
}

}  // namespace xr3
