#include "protocol/line/com_port.hpp"

#include <algorithm>
#include <string_view>

#include "protocol/line/telnet_codes.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;
using Bytes = std::span<const std::uint8_t>;

/// The sizes of the values of requests in bytes, by code from 1; code 6 is only for servers.
constexpr std::uint8_t kUnknown = 255;
constexpr std::array<std::uint8_t, 12> kValueBytes = {4, 1, 1, 1, 1, kUnknown, 0, 0, 0, 1, 1, 1};

/// The value 0 of a setting asks for the one in effect.
constexpr std::uint8_t kAsk = 0;

constexpr std::array<std::uint8_t, 3> kName = {'x', 'r', '3'};

/// Carrier 80, ring 40, DSR 20, CTS 10; the low bits would say what has changed.
constexpr std::uint8_t kModemState = 0xb0;

/// The bit of the line state.
constexpr std::uint8_t kParityError = 0x04;

/// Requests by the value of PURGE-DATA from 1.
constexpr std::array kPurges = {BufferControl::kDropReplies, BufferControl::kDropInput,
                                BufferControl::kDropBoth};

/// The values of SET-CONTROL: the one that asks, and those that set.
struct Control {
  std::uint8_t ask;
  std::string_view sets;
};
constexpr std::array<Control, 5> kControls = {{
    {0, "\x01\x02\x03\x11\x13"sv},  // flow control out, or both ways: none, XON/XOFF, by a signal
    {4, "\x05\x06"sv},              // break: on, off
    {7, "\x08\x09"sv},              // DTR: on, off
    {10, "\x0b\x0c"sv},             // RTS: on, off
    {13, "\x0e\x0f\x10\x12"sv},     // flow control in: none, XON/XOFF, by a signal
}};

bool is_valid(Bytes request) {
  const std::size_t code = request[0];
  return code >= 1 && code <= kValueBytes.size() && request.size() - 1 == kValueBytes[code - 1];
}

void append_answer(std::string& out, std::uint8_t code, Bytes value) {
  append_com_port(out, static_cast<std::uint8_t>(code + com_port::kAnswer), value);
}

/// Sets a value that the protocol counts from 1. Returns the value for the answer.
template <class Value>
std::uint8_t set_from_1(Value& setting, std::uint8_t value, Value max) {
  if (value == kAsk) return static_cast<std::uint8_t>(static_cast<std::uint8_t>(setting) + 1);
  if (value - 1 <= static_cast<std::uint8_t>(max)) setting = static_cast<Value>(value - 1);
  return value;
}

}  // namespace

BufferControl ComPort::handle(Bytes request, std::string& answers) {
  if (request.size() == 1 && request[0] == com_port::kSignature)
    append_answer(answers, com_port::kSignature, kName);
  if (request.empty() || !is_valid(request)) return BufferControl::kNone;
  const std::uint8_t code = request[0];
  const Bytes value = request.subspan(1);
  switch (code) {
    case com_port::kSetBaudRate: set_baud(value, answers); break;
    case com_port::kNotifyModemState: append_modem_state(answers); break;
    case com_port::kFlowControlSuspend: return BufferControl::kSuspend;
    case com_port::kFlowControlResume: return BufferControl::kResume;
    case com_port::kPurgeData: {
      append_answer(answers, code, value);
      const bool is_known = value[0] >= 1 && value[0] <= kPurges.size();
      return is_known ? kPurges[value[0] - 1U] : BufferControl::kNone;
    }
    default: {
      const std::array answer = {set(code, value[0])};
      append_answer(answers, code, answer);
    }
  }
  return BufferControl::kNone;
}

void ComPort::append_modem_state(std::string& answers) {
  constexpr std::array kValue = {kModemState};
  append_answer(answers, com_port::kNotifyModemState, kValue);
}

void ComPort::append_parity_error(std::string& answers) const {
  constexpr std::array kValue = {kParityError};
  if ((line_state_mask_ & kParityError) != 0)
    append_answer(answers, com_port::kNotifyLineState, kValue);
}

void ComPort::set_baud(Bytes value, std::string& answers) {
  std::uint32_t baud = 0;
  for (const std::uint8_t byte : value) baud = baud << 8 | byte;
  if (baud != kAsk) baud_ = baud;
  append_baud(answers, com_port::kSetBaudRate + com_port::kAnswer, baud_);
}

/// Sets the setting of a request with a value of one byte. Returns the value for the answer.
std::uint8_t ComPort::set(std::uint8_t code, std::uint8_t value) {
  switch (code) {
    case com_port::kSetDataSize: return set_data_bits(value);
    case com_port::kSetParity: return set_from_1(frame_.parity, value, Parity::kSpace);
    case com_port::kSetStopSize: return set_from_1(frame_.stop_bits, value, StopBits::kOneAndAHalf);
    case com_port::kSetControl: return set_control(value);
    case com_port::kSetLineStateMask: return line_state_mask_ = value;
    default: return value;  // a mask: the states that it selects never change
  }
}

std::uint8_t ComPort::set_data_bits(std::uint8_t value) {
  if (value == kAsk) return static_cast<std::uint8_t>(frame_.data_bits);
  if (value >= kMinDataBits && value <= kMaxDataBits) frame_.data_bits = value;
  return value;
}

std::uint8_t ComPort::set_control(std::uint8_t value) {
  for (std::size_t i = 0; i < kControls.size(); ++i) {
    if (value == kControls[i].ask) return controls_[i];
    if (kControls[i].sets.find(static_cast<char>(value)) != std::string_view::npos) {
      controls_[i] = value;
    }
  }
  return value;
}

SerialSettings ComPort::settings() const {
  SerialSettings settings{baud_, frame_};
  switch (controls_[0]) {
    case com_port::kFlowNone: settings.frame->flow = FlowControl::kNone; break;
    case com_port::kFlowXonXoff: settings.frame->flow = FlowControl::kSoftware; break;
    default: settings.frame->flow = FlowControl::kHardware; break;
  }
  return settings;
}

}  // namespace xr3
