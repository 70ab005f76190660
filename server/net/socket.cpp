#include "server/net/socket.hpp"

#include <netinet/tcp.h>

#include <algorithm>
#include <boost/asio/bind_cancellation_slot.hpp>
#include <boost/asio/buffer.hpp>
#include <utility>

#include "server/net/acknowledge.hpp"

namespace xr3 {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kMaxStuck{30};
constexpr milliseconds kMaxLinger{500};
constexpr std::size_t kMaxLingerBytes = 16 * 1024 * 1024;
// Ends the connection if the peer does not acknowledge sent bytes. (TCP keepalive works only while
// none are unacknowledged.)
void limit_unacknowledged(tcp::socket& socket) {
  const int timeout = static_cast<int>(milliseconds(kMaxStuck).count());
  ::setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_USER_TIMEOUT, &timeout, sizeof timeout);
}

bool must_wait(ErrorCode error) {
  return error == asio::error::would_block || error == asio::error::try_again;
}

void close_when_due(asio::steady_timer& timer, milliseconds time,
                    std::shared_ptr<tcp::socket> socket) {
  run_after(timer, time, [socket = std::move(socket)] {
    ErrorCode ignored;
    socket->close(ignored);
  });
}

}  // namespace

MonitorSocket::MonitorSocket(tcp::socket socket, MemoryLimit* limit)
    : socket_(std::make_shared<tcp::socket>(std::move(socket))),
      limit_(limit),
      deadline_(socket_->get_executor()),
      stuck_(socket_->get_executor()),
      buffer_() {
  limit_unacknowledged(*socket_);
}

asio::awaitable<std::string_view> MonitorSocket::read() {
  acknowledge();
  if (reading_->is_stopped) co_return read_arrived();
  const auto [error, count] = co_await socket_->async_read_some(
      asio::buffer(buffer_), asio::bind_cancellation_slot(reading_->waiting.slot(), kAwait));
  const bool is_stopped = error == asio::error::operation_aborted && reading_->is_stopped;
  co_return received(is_stopped ? ErrorCode() : error, count);
}

void MonitorSocket::acknowledge() {
  if (is_open() && std::exchange(is_unacknowledged_, false))
    acknowledge_received(socket_->native_handle());
}

/// The bytes that have arrived already.
std::string_view MonitorSocket::read_arrived() {
  ErrorCode error;
  const std::size_t count = socket_->read_some(asio::buffer(buffer_), error);
  return received(must_wait(error) ? ErrorCode() : error, count);
}

std::string_view MonitorSocket::received(ErrorCode error, std::size_t count) {
  if (error && error != asio::error::eof) close();
  if (!is_open()) return {};
  count_bytes(count);
  is_unacknowledged_ = count > 0;
  return {buffer_.data(), count};
}

asio::awaitable<bool> MonitorSocket::send(std::string_view bytes, std::string_view more) {
  while (is_open() && bytes.size() + more.size() > 0) {
    const std::array buffers{asio::buffer(bytes), asio::buffer(more)};
    const std::size_t count = send_some(buffers);
    const std::size_t of_bytes = std::min(count, bytes.size());
    bytes.remove_prefix(of_bytes);
    more.remove_prefix(count - of_bytes);
    if (count > 0 || !is_open()) continue;
    const bool is_writable = co_await wait_until_writable();
    if (!is_writable) close();
  }
  co_return is_open();
}

std::size_t MonitorSocket::send_some(std::span<const asio::const_buffer> buffers) {
  ErrorCode error;
  const std::size_t count = buffers.size() == 1 ? socket_->write_some(buffers.front(), error)
                                                : socket_->write_some(buffers, error);
  if (error && !must_wait(error)) close();
  if (count > 0) is_unacknowledged_ = false;
  count_bytes(asio::buffer_size(buffers));
  return count;
}

void MonitorSocket::when_writable(std::function<void()> ready) {
  close_when_due(stuck_, kMaxStuck, socket_);
  socket_->async_wait(tcp::socket::wait_write,
                      [this, socket = socket_, ready = std::move(ready)](ErrorCode) {
                        if (socket->is_open()) stuck_.cancel();
                        ready();
                      });
}

asio::awaitable<bool> MonitorSocket::wait_until_writable() {
  close_when_due(stuck_, kMaxStuck, socket_);
  const auto [error] = co_await socket_->async_wait(tcp::socket::wait_write, kAwait);
  stuck_.cancel();
  co_return !error && is_open();
}

asio::awaitable<void> MonitorSocket::linger() {
  ErrorCode ignored;
  socket_->shutdown(tcp::socket::shutdown_send, ignored);
  close_after(kMaxLinger);
  for (std::size_t forgotten = 0; is_open() && forgotten < kMaxLingerBytes;) {
    const auto [error, count] = co_await socket_->async_read_some(asio::buffer(buffer_), kAwait);
    if (error) break;
    count_bytes(count);
    forgotten += count;
  }
  close();
}

void MonitorSocket::close_after(milliseconds time) { close_when_due(deadline_, time, socket_); }

void MonitorSocket::stop_reading_after(milliseconds time) {
  run_after(deadline_, time, [socket = socket_, reading = reading_] {
    if (!socket->is_open()) return;
    reading->has_waited_enough = true;
    reading->stop();
  });
}

void MonitorSocket::stop_reading() { reading_->stop(); }

void MonitorSocket::ReadState::stop() {
  is_stopped = true;
  waiting.emit(asio::cancellation_type::terminal);
}

// (The destructors of the timers cancel them.)
MonitorSocket::~MonitorSocket() {
  ErrorCode ignored;
  socket_->close(ignored);
}

void MonitorSocket::close() {
  ErrorCode ignored;
  socket_->close(ignored);
  deadline_.cancel();
  stuck_.cancel();
}

}  // namespace xr3
