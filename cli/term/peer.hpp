// The other end of the line of `xr3 term`: a TCP port, a terminal server, or a device.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "server/net/asio.hpp"

namespace xr3 {

class TermPeer {
 public:
  TermPeer() = default;
  TermPeer(const TermPeer&) = delete;
  TermPeer& operator=(const TermPeer&) = delete;
  virtual ~TermPeer() = default;

  /// Received data, valid until the next read. Empty if the peer has ended, or is lost.
  virtual asio::awaitable<std::string_view> read() = 0;
  /// Sends the data, and pending protocol bytes. False if the peer is lost.
  virtual asio::awaitable<bool> write(std::string_view data) = 0;
  /// Sends a break. Returns the reason if that is not possible. Not during a write.
  virtual asio::awaitable<std::string> send_break() = 0;

  /// Whether protocol bytes are pending: write() must be called, if only with no data.
  virtual bool has_protocol_bytes() const { return false; }
  /// Whether the peer has asked to send no data for now.
  virtual bool is_suspended() const { return false; }
  /// Calls `due` when one of the two may have changed.
  // NOLINTNEXTLINE(performance-unnecessary-value-param): other peers keep it
  virtual void when_protocol(std::function<void()> /*due*/) {}

  /// Announces that no more data will be sent. Returns whether the peer can then end the line
  /// itself.
  virtual bool finish() = 0;
};

}  // namespace xr3
