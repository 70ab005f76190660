// The bytes of the telnet protocol (RFC 854, 856, 858, 860, 2217) that xr3 uses.
#pragma once

#include <cstdint>

namespace xr3::telnet {

inline constexpr std::uint8_t kSe = 0xf0;  ///< also the lowest command
inline constexpr std::uint8_t kInterrupt = 0xf4;
inline constexpr std::uint8_t kSb = 0xfa;
inline constexpr std::uint8_t kWill = 0xfb;
inline constexpr std::uint8_t kWont = 0xfc;
inline constexpr std::uint8_t kDo = 0xfd;
inline constexpr std::uint8_t kDont = 0xfe;
inline constexpr std::uint8_t kIac = 0xff;

inline constexpr std::uint8_t kBinary = 0;
inline constexpr std::uint8_t kSuppressGoAhead = 3;
inline constexpr std::uint8_t kTimingMark = 6;
inline constexpr std::uint8_t kComPort = 44;

}  // namespace xr3::telnet
