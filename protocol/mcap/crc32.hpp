// The checksum of MCAP, zlib and PNG. zlib itself is no choice here: this library compiles for the
// page without it.
#pragma once

#include <cstdint>
#include <string_view>

namespace xr3::mcap {

class Crc32 {
 public:
  void add(std::string_view bytes);
  /// The CRC-32 of ISO 3309 of all bytes so far.
  std::uint32_t value() const { return ~crc_; }

 private:
  std::uint32_t crc_ = UINT32_MAX;
};

std::uint32_t crc32(std::string_view bytes);

}  // namespace xr3::mcap
