// A TCP connection of the robot port, read and written without waiting. It is no Asio socket: the event
// loop would watch each one, and a thousand lines are cheaper watched together (`line_watch`).
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "server/asio.hpp"

namespace xr3 {

class RobotSocket {
 public:
  /// Takes the connection, non-blocking, out of Asio's hands. Dead peers are found by TCP keepalive.
  explicit RobotSocket(tcp::socket socket);
  RobotSocket(const RobotSocket&) = delete;
  RobotSocket& operator=(const RobotSocket&) = delete;
  ~RobotSocket() { close(); }

  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }

  /// How many bytes there were. 0: none now, or none ever, which has_ended() and is_lost() tell.
  std::size_t read(std::span<char> into);
  /// How many bytes the connection took now. 0: none, or it is lost.
  std::size_t write(std::string_view bytes);

  /// The client sends no more.
  bool has_ended() const { return has_ended_; }
  /// The connection is broken.
  bool is_lost() const { return is_lost_; }

  void close();

 private:
  int descriptor_;
  bool has_ended_ = false;
  bool is_lost_ = false;
};

}  // namespace xr3
