// The room that the recordings of all cells in a run of the server share.
#pragma once

#include <cstdint>
#include <string>

namespace xr3 {

class RecordingRoom {
 public:
  /// `max_bytes`: of all recordings together.
  explicit RecordingRoom(std::uint64_t max_bytes) : max_bytes_(max_bytes) {}
  RecordingRoom(const RecordingRoom&) = delete;
  RecordingRoom& operator=(const RecordingRoom&) = delete;

  /// The reason why a recording cannot have more bytes; empty if it can.
  std::string refusal(std::uint64_t bytes) const;
  /// Precondition: they are not refused.
  void take(std::uint64_t bytes) { taken_ += bytes; }

 private:
  std::uint64_t max_bytes_;
  std::uint64_t taken_ = 0;
};

}  // namespace xr3
