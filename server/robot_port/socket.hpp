// A TCP connection of the robot port with non-blocking I/O. It is not an Asio socket: the event
// loop would watch each one, and watching a thousand lines together is cheaper (`line_watch`).
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "server/net/asio.hpp"

namespace xr3 {

class RobotSocket {
 public:
  /// Takes over the descriptor of the socket, which must be non-blocking. TCP keepalive detects
  /// dead peers.
  explicit RobotSocket(tcp::socket socket);
  RobotSocket(const RobotSocket&) = delete;
  RobotSocket& operator=(const RobotSocket&) = delete;
  ~RobotSocket() { close(); }

  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }

  /// The number of bytes read. 0: none now, or none any more if has_ended() or is_lost().
  std::size_t read(std::span<char> into);
  /// The number of bytes written. 0: none now, or is_lost().
  std::size_t write(std::string_view bytes);

  /// The client has shut down its sending side.
  bool has_ended() const { return has_ended_; }
  /// The connection is broken.
  bool is_lost() const { return is_lost_; }

  void close();

 private:
  int descriptor_;
  bool has_written_ = false;
  bool has_ended_ = false;
  bool is_lost_ = false;
};

}  // namespace xr3
