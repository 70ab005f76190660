#include "protocol/line/telnet_parser.hpp"

namespace xr3 {

TelnetItem TelnetParser::feed_protocol(std::uint8_t byte) {
  switch (mode_) {
    case Mode::kData: mode_ = Mode::kCommand; return {};
    case Mode::kCommand: return feed_command(byte);
    case Mode::kOption: mode_ = Mode::kData; return {TelnetItem::Kind::kOption, verb_, byte};
    default: return feed_subnegotiation(byte);
  }
}

bool TelnetParser::is_data(std::uint8_t byte) const {
  if (mode_ == Mode::kData) return byte != telnet::kIac;
  return mode_ == Mode::kCommand && (byte < telnet::kSe || byte == telnet::kIac);
}

// Handles the byte after IAC. If it is not a telnet command, it is data, and only the FF is lost.
TelnetItem TelnetParser::feed_command(std::uint8_t byte) {
  const bool is_byte_of_data = is_data(byte);
  mode_ = Mode::kData;
  if (is_byte_of_data) return {TelnetItem::Kind::kData, byte};
  if (byte == telnet::kSb) {
    mode_ = Mode::kSubnegotiation;
    length_ = 0;
    kept_bytes_ = 0;
    return {};
  }
  if (byte >= telnet::kWill) {
    mode_ = Mode::kOption;
    verb_ = byte;
    return {};
  }
  return {TelnetItem::Kind::kCommand, byte};
}

TelnetItem TelnetParser::feed_subnegotiation(std::uint8_t byte) {
  const bool is_after_iac = mode_ == Mode::kSubnegotiationCommand;
  if (!is_after_iac && byte == telnet::kIac) {
    mode_ = Mode::kSubnegotiationCommand;
    return {};
  }
  mode_ = Mode::kSubnegotiation;
  if (is_after_iac && byte == telnet::kSe) {
    mode_ = Mode::kData;
    return {TelnetItem::Kind::kSubnegotiation};
  }
  if (!is_after_iac || byte == telnet::kIac) keep(byte);
  if (++length_ > kMaxSubnegotiationBytes) mode_ = Mode::kData;
  return {};
}

void TelnetParser::keep(std::uint8_t byte) {
  if (kept_bytes_ < kept_.size()) kept_[kept_bytes_++] = byte;
}

}  // namespace xr3
