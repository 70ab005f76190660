// A TCP connection of the monitor port with its patience: reading, writing to a client that may
// take nothing, and closing so that the last words still arrive. It knows no language.
#pragma once

#include <array>
#include <boost/asio/buffer.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "server/asio.hpp"
#include "server/prefetch.hpp"

namespace xr3 {

class MonitorSocket {
 public:
  /// The socket is non-blocking. Dead peers are found by TCP keepalive.
  explicit MonitorSocket(tcp::socket socket);
  MonitorSocket(const MonitorSocket&) = delete;
  MonitorSocket& operator=(const MonitorSocket&) = delete;
  ~MonitorSocket();

  bool is_open() const { return socket_->is_open(); }
  /// For those who bring their own way of reading and writing.
  tcp::socket& stream() { return *socket_; }
  asio::any_io_executor executor() const { return socket_->get_executor(); }

  /// Some bytes, valid until the next read. Empty: the client has stopped sending, or, if the
  /// socket is not open any more, the connection is lost.
  asio::awaitable<std::string_view> read();

  /// Sends all of it. False: the connection is lost, or the client took no byte for 30 s.
  asio::awaitable<bool> send(std::string_view bytes);

  /// Sends as much as the connection takes now, and returns how much that was; 0 and not open where it
  /// is lost.
  std::size_t send_some(std::span<const asio::const_buffer> buffers);

  /// Brings what send_some() will touch.
  void prefetch() const { xr3::prefetch(socket_.get()); }

  /// Calls `ready` when more can be sent, or when the connection is lost, at the latest after 30 s.
  void when_writable(std::function<void()> ready);

  /// Waits a moment, reading and forgetting, for the client to close, so that what was sent last is
  /// not destroyed by what it is still sending; then closes.
  asio::awaitable<void> linger();

  /// Closes when so much time has passed, unless it is called off.
  void close_after(std::chrono::milliseconds time);
  /// Reads no more when so much time has passed, unless it is called off: read() then finds an end.
  void stop_reading_after(std::chrono::milliseconds time);
  /// It was stopped by that.
  bool has_waited_enough() const { return *has_waited_enough_; }
  void call_off() { deadline_.cancel(); }

  /// No byte is read any more; what can be sent still is.
  void stop_reading();
  void close();

 private:
  asio::awaitable<bool> wait_until_writable();

  std::shared_ptr<tcp::socket> socket_;  ///< shared with timers that close it
  std::shared_ptr<bool> has_waited_enough_ = std::make_shared<bool>(false);
  asio::steady_timer deadline_;
  asio::steady_timer stuck_;
  std::array<char, 8192> buffer_;
};

}  // namespace xr3
