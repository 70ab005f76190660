#include "protocol/line/telnet_client.hpp"

#include <array>
#include <cassert>
#include <initializer_list>

#include "protocol/line/telnet_codes.hpp"

namespace xr3 {
namespace {

using enum TelnetOptions::Side;

constexpr std::initializer_list<std::uint8_t> kSettingCodes = {
    com_port::kSetBaudRate, com_port::kSetDataSize, com_port::kSetParity, com_port::kSetStopSize,
    com_port::kSetControl};

std::uint32_t bit_of_code(std::uint8_t code) { return 1U << code; }

std::uint32_t all_setting_bits() {
  std::uint32_t bits = 0;
  for (const std::uint8_t code : kSettingCodes) bits |= bit_of_code(code);
  return bits;
}

/// Values that the protocol counts from 1.
template <class Value>
std::uint8_t from_1(Value value) {
  return static_cast<std::uint8_t>(static_cast<std::uint8_t>(value) + 1);
}
template <class Value>
void read_from_1(Value& setting, std::uint8_t value, Value max) {
  if (value >= 1 && value <= from_1(max)) setting = static_cast<Value>(value - 1);
}

void append_byte(std::string& out, std::uint8_t code, std::uint8_t value) {
  append_com_port(out, code, std::array{value});
}

}  // namespace

std::string TelnetClient::opening() {
  std::string requests;
  for (const std::uint8_t option : {telnet::kBinary, telnet::kSuppressGoAhead}) {
    options_.ask(kOwn, option, requests);
    options_.ask(kPeer, option, requests);
  }
  options_.ask(kOwn, telnet::kComPort, requests);
  return requests;
}

std::optional<std::uint8_t> TelnetClient::feed(std::uint8_t byte, std::string& answers) {
  const TelnetItem item = parser_.feed(byte);
  switch (item.kind) {
    case TelnetItem::ItemKind::kData: return item.byte;
    case TelnetItem::ItemKind::kOption: {
      const bool had_com_port = has_com_port();
      options_.negotiate(item.byte, item.option, answers);
      if (has_com_port() && !had_com_port) request_settings(answers);
      break;
    }
    case TelnetItem::ItemKind::kSubnegotiation: handle_answer(); break;
    default: break;
  }
  return std::nullopt;
}

bool TelnetClient::has_com_port() const { return options_.is_on(kOwn, telnet::kComPort); }

bool TelnetClient::is_settled() const {
  if (options_.is_asked(kOwn, telnet::kComPort)) return false;
  return !has_com_port() || (answered_ & all_setting_bits()) == all_setting_bits();
}

SerialSettings TelnetClient::settings() const {
  return is_settled() && has_com_port() ? confirmed_ : wanted_;
}

void TelnetClient::append_break(bool is_on, std::string& out) const {
  assert(has_com_port());
  append_byte(out, com_port::kSetControl, is_on ? com_port::kBreakOn : com_port::kBreakOff);
}

void TelnetClient::request_settings(std::string& out) const {
  const SerialFrame frame = wanted_.frame.value_or(SerialFrame{});
  append_baud(out, com_port::kSetBaudRate, wanted_.baud);
  append_byte(out, com_port::kSetDataSize, static_cast<std::uint8_t>(frame.data_bits));
  append_byte(out, com_port::kSetParity, from_1(frame.parity));
  append_byte(out, com_port::kSetStopSize, from_1(frame.stop_bits));
  append_byte(out, com_port::kSetControl, from_1(frame.flow));
}

void TelnetClient::handle_answer() {
  const auto kept = parser_.subnegotiation();
  if (kept.size() < 2 || kept[0] != telnet::kComPort || kept[1] < com_port::kAnswer) return;
  const auto code = static_cast<std::uint8_t>(kept[1] - com_port::kAnswer);
  const auto value = kept.subspan(2);
  if (code == com_port::kFlowControlSuspend) is_suspended_ = true;
  if (code == com_port::kFlowControlResume) is_suspended_ = false;
  if (value.size() != (code == com_port::kSetBaudRate ? 4U : 1U)) return;
  SerialFrame& frame = *confirmed_.frame;
  switch (code) {
    case com_port::kSetBaudRate:
      confirmed_.baud = 0;
      for (const std::uint8_t byte : value) confirmed_.baud = confirmed_.baud << 8U | byte;
      break;
    case com_port::kSetDataSize: frame.data_bits = value[0]; break;
    case com_port::kSetParity: read_from_1(frame.parity, value[0], Parity::kSpace); break;
    case com_port::kSetStopSize:
      read_from_1(frame.stop_bits, value[0], StopBits::kOneAndAHalf);
      break;
    case com_port::kSetControl: read_from_1(frame.flow, value[0], FlowControl::kHardware); break;
    default: return;
  }
  answered_ |= bit_of_code(code);
}

}  // namespace xr3
