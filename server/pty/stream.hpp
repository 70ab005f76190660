// The event loop's end of a pseudo-terminal as the stream of a serial line: a socket, and the
// settings of the program that has the terminal open.
#pragma once

#include "server/pty/shared.hpp"
#include "server/robot_port/socket.hpp"

namespace xr3 {

class PtyStream final : public RobotSocket {
 public:
  /// Counts up `progress` with each read that gives bytes. The references must outlive the stream.
  PtyStream(Descriptor line, PtyShared& shared, std::uint64_t& progress);

  /// Reads bytes that have the same settings.
  std::size_t read(std::span<char> into) override;
  /// The settings of the bytes that were read last; before the first read, those of the first byte.
  std::optional<LineSettings> changed_settings(LineId line) override;
  void acknowledge() override {}
  /// The bytes of one round of the thread, which moves more while they are read.
  std::size_t max_settled() const override { return kPtyRound; }

 private:
  void reach_changes();

  PtyShared& shared_;
  std::uint64_t& progress_;
  std::uint64_t offset_ = 0;  ///< offset of the next byte
  PtyModes modes_;            ///< modes of the byte before, or of the first one
  PtyModes taken_;
};

}  // namespace xr3
