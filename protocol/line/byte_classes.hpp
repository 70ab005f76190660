// Classes of bytes of the serial line.
#pragma once

#include <cstdint>

namespace xr3 {

inline bool is_line_end(std::uint8_t byte) { return byte == '\r' || byte == '\n'; }
inline bool is_space(std::uint8_t byte) { return byte == ' ' || byte == '\0'; }

/// The letter in upper case, or 0 if the byte is no letter.
inline std::uint8_t letter_of(std::uint8_t byte) {
  if (byte >= 'a' && byte <= 'z') return static_cast<std::uint8_t>(byte - 'a' + 'A');
  return byte >= 'A' && byte <= 'Z' ? byte : std::uint8_t{0};
}

}  // namespace xr3
