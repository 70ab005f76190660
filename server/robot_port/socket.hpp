// A TCP connection of the robot port as the stream of a serial line.
#pragma once

#include "server/lines/stream.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

class RobotSocket final : public LineStream {
 public:
  /// Takes over the descriptor of the socket, which must be non-blocking. TCP keepalive detects
  /// dead peers.
  explicit RobotSocket(tcp::socket socket);
  ~RobotSocket() override { RobotSocket::close(); }

  int descriptor() const override { return descriptor_; }
  std::size_t read(std::span<char> into) override;
  std::size_t write(std::string_view bytes) override;
  void close() override;

 private:
  int descriptor_;
  bool has_written_ = false;
};

}  // namespace xr3
