// A TCP connection of the monitor port: reading and writing with time limits, and closing without
// losing the last bytes sent. Independent of the protocol.
#pragma once

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/cancellation_signal.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "server/net/asio.hpp"
#include "server/net/memory_limit.hpp"

namespace xr3 {

class MonitorSocket {
 public:
  /// Precondition: the socket is non-blocking. The bytes of the connection count towards `limit`,
  /// if there is one.
  explicit MonitorSocket(tcp::socket socket, MemoryLimit* limit = nullptr);
  MonitorSocket(const MonitorSocket&) = delete;
  MonitorSocket& operator=(const MonitorSocket&) = delete;
  ~MonitorSocket();

  bool is_open() const { return socket_->is_open(); }
  /// The socket, for users that do their own I/O (WebSocket).
  tcp::socket& stream() { return *socket_; }
  asio::any_io_executor executor() const { return socket_->get_executor(); }

  /// Received bytes, valid until the next read. Acknowledges those of the last one, unless bytes
  /// were sent after it. Empty if the client has stopped sending, or if the connection is lost
  /// (is_open() is then false).
  asio::awaitable<std::string_view> read();

  /// Sends all bytes, then `more`. False if the connection is lost or the client accepted no byte
  /// for 30 s.
  asio::awaitable<bool> send(std::string_view bytes, std::string_view more = {});

  /// Sends as much as the connection accepts now; returns the number of bytes. Closes a lost
  /// connection and returns 0.
  std::size_t send_some(std::span<const asio::const_buffer> buffers);

  /// Counts bytes that users with their own I/O have received or queued.
  void count_bytes(std::size_t bytes) const { note(limit_, bytes); }

  /// Calls `ready` when more can be sent or the connection is lost, after at most 30 s.
  void when_writable(std::function<void()> ready);

  /// Shuts down the sending side, then reads and discards for up to 500 ms until the client closes;
  /// then closes. Otherwise bytes that the client is still sending would cause a reset, which can
  /// destroy the last bytes sent to it.
  asio::awaitable<void> linger();

  /// Closes after this time, unless cancelled by call_off().
  void close_after(std::chrono::milliseconds time);
  /// Stops reading after this time, unless cancelled by call_off().
  void stop_reading_after(std::chrono::milliseconds time);
  /// Whether stop_reading_after() has stopped reading.
  bool has_waited_enough() const { return reading_->has_waited_enough; }
  void call_off() { deadline_.cancel(); }

  /// Stops reading: read() then returns only what has arrived already. (The receiving side is not
  /// shut down: the next byte of the client would then reset the connection, see linger().)
  void stop_reading();
  void close();

 private:
  /// Shared with the handler of a timer, which stops reading.
  struct ReadState {
    void stop();

    bool is_stopped = false;
    bool has_waited_enough = false;
    asio::cancellation_signal waiting;  ///< ends the read that waits for bytes
  };

  void acknowledge();
  std::string_view read_arrived();
  std::string_view received(ErrorCode error, std::size_t count);
  asio::awaitable<bool> wait_until_writable();

  std::shared_ptr<tcp::socket> socket_;  ///< shared with the handlers of the timers, which close it
  std::shared_ptr<ReadState> reading_ = std::make_shared<ReadState>();
  MemoryLimit* limit_;
  bool is_unacknowledged_ = false;  ///< bytes were received after the last ones sent
  asio::steady_timer deadline_;
  asio::steady_timer stuck_;
  std::array<char, 8192> buffer_;
};

}  // namespace xr3
