// The codes of the COM-PORT option (RFC 2217), and the bytes around a request or an answer.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace xr3 {
namespace com_port {

/// The client's codes; an answer has that of the request and kAnswer.
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
  kSetModemStateMask = 11,
  kPurgeData = 12,
};
inline constexpr std::uint8_t kAnswer = 100;

/// Values of SET-CONTROL.
inline constexpr std::uint8_t kFlowNone = 1;
inline constexpr std::uint8_t kFlowXonXoff = 2;
inline constexpr std::uint8_t kFlowRtsCts = 3;
inline constexpr std::uint8_t kBreakOn = 5;
inline constexpr std::uint8_t kBreakOff = 6;

}  // namespace com_port

/// Appends a subnegotiation of COM-PORT; FF in the value is doubled.
void append_com_port(std::string& out, std::uint8_t code, std::span<const std::uint8_t> value);

}  // namespace xr3
