// Adjacent bytes of one direction of a line that have not been recorded yet.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace xr3 {

struct ByteRun {
  std::uint64_t from = 0;  ///< offset of the first byte in the line's stream in this direction
  std::string bytes;

  bool empty() const { return bytes.empty(); }
  /// Whether bytes at this offset extend the run.
  bool is_followed_by(std::uint64_t offset) const {
    return bytes.empty() || offset == from + bytes.size();
  }
  /// Precondition: is_followed_by(offset).
  void add(std::uint64_t offset, std::string_view more) {
    if (bytes.empty()) from = offset;
    bytes += more;
  }
  bool operator==(const ByteRun&) const = default;
};

}  // namespace xr3
