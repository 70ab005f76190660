// The bytes of the telnet protocol (RFC 854, 856, 858, 860) and of its option COM-PORT (RFC 2217)
// that xr3 uses.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace xr3::telnet {

inline constexpr std::uint8_t kSe = 0xf0;  ///< end of a subnegotiation, and the lowest command
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

namespace xr3::com_port {

/// The client's codes in the COM-PORT option; an answer has that of the request and kAnswer.
enum Code : std::uint8_t {
  kSignature = 0,
  kSetBaudRate = 1,
  kSetDataSize = 2,
  kSetParity = 3,
  kSetStopSize = 4,
  kSetControl = 5,
  kNotifyLineState = 6,
  kNotifyModemState = 7,
  kFlowControlSuspend = 8,
  kFlowControlResume = 9,
  kSetLineStateMask = 10,
  kPurgeData = 12,
};
inline constexpr std::uint8_t kAnswer = 100;

/// Values of SET-CONTROL.
inline constexpr std::uint8_t kFlowNone = 1;
inline constexpr std::uint8_t kFlowXonXoff = 2;
inline constexpr std::uint8_t kBreakOn = 5;
inline constexpr std::uint8_t kBreakOff = 6;

}  // namespace xr3::com_port

namespace xr3 {

/// Appends data in the encoding of telnet: FF is doubled.
void append_escaped(std::string& out, std::string_view data);

/// Appends a subnegotiation of COM-PORT; FF in the value is doubled.
void append_com_port(std::string& out, std::uint8_t code, std::span<const std::uint8_t> value);
/// Appends a subnegotiation with a speed as the value of SET-BAUDRATE.
void append_baud(std::string& out, std::uint8_t code, std::uint32_t baud);

}  // namespace xr3
