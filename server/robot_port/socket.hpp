// A connected socket as the stream of a serial line: a TCP connection of the robot port, or one end
// of a socket pair.
#pragma once

#include <string>
#include <utility>

#include "server/files/descriptor.hpp"
#include "server/lines/stream.hpp"

namespace xr3 {

class RobotSocket : public LineStream {
 public:
  /// `early`: bytes of the connection that were read before; read() returns them first.
  explicit RobotSocket(Descriptor connection, std::string early = {})
      : connection_(std::move(connection)), early_(std::move(early)) {}
  ~RobotSocket() override { RobotSocket::close(); }

  int descriptor() const override { return connection_.get(); }
  std::size_t read(std::span<char> into) override;
  std::size_t write(std::string_view bytes) override;
  void close() override;
  void acknowledge() override;

 private:
  Descriptor connection_;
  std::string early_;
  bool has_written_ = false;
  bool is_unacknowledged_ = false;  ///< bytes were read after the last write
};

}  // namespace xr3
