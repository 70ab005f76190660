// A TCP connection of the robot port as the stream of a serial line.
#pragma once

#include "server/files/descriptor.hpp"
#include "server/lines/stream.hpp"

namespace xr3 {

class RobotSocket final : public LineStream {
 public:
  /// Precondition: the connection is non-blocking.
  explicit RobotSocket(Descriptor connection) : connection_(std::move(connection)) {}
  ~RobotSocket() override { RobotSocket::close(); }

  int descriptor() const override { return connection_.get(); }
  std::size_t read(std::span<char> into) override;
  std::size_t write(std::string_view bytes) override;
  void close() override;
  void acknowledge() override;

 private:
  Descriptor connection_;
  bool has_written_ = false;
  bool is_unacknowledged_ = false;  ///< bytes were read after the last write
};

}  // namespace xr3
