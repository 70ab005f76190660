#include "protocol/line/telnet_parser.hpp"

namespace xr3 {

TelnetItem TelnetParser::feed_protocol(std::uint8_t byte) {
  switch (mode_) {
    case TelnetMode::kData: mode_ = TelnetMode::kCommand; return {};
    case TelnetMode::kCommand: return feed_command(byte);
    case TelnetMode::kOption:
      mode_ = TelnetMode::kData;
      return {TelnetItem::ItemKind::kOption, verb_, byte};
    default: return feed_subnegotiation(byte);
  }
}

bool TelnetParser::is_data(std::uint8_t byte) const {
  if (mode_ == TelnetMode::kData) return byte != telnet::kIac;
  return mode_ == TelnetMode::kCommand && (byte < telnet::kSe || byte == telnet::kIac);
}

// Handles the byte after IAC. If it is not a telnet command, it is data, and only the FF is lost.
TelnetItem TelnetParser::feed_command(std::uint8_t byte) {
  const bool is_byte_of_data = is_data(byte);
  mode_ = TelnetMode::kData;
  if (is_byte_of_data) return {TelnetItem::ItemKind::kData, byte};
  if (byte == telnet::kSb) {
    mode_ = TelnetMode::kSubnegotiation;
    length_ = 0;
    kept_bytes_ = 0;
    return {};
  }
  if (byte >= telnet::kWill) {
    mode_ = TelnetMode::kOption;
    verb_ = byte;
    return {};
  }
  return {TelnetItem::ItemKind::kCommand, byte};
}

TelnetItem TelnetParser::feed_subnegotiation(std::uint8_t byte) {
  const bool is_after_iac = mode_ == TelnetMode::kSubnegotiationCommand;
  if (!is_after_iac && byte == telnet::kIac) {
    mode_ = TelnetMode::kSubnegotiationCommand;
    return {};
  }
  mode_ = TelnetMode::kSubnegotiation;
  if (is_after_iac && byte == telnet::kSe) {
    mode_ = TelnetMode::kData;
    return {TelnetItem::ItemKind::kSubnegotiation};
  }
  if (!is_after_iac || byte == telnet::kIac) keep(byte);
  if (++length_ > kMaxSubnegotiationBytes) mode_ = TelnetMode::kData;
  return {};
}

void TelnetParser::keep(std::uint8_t byte) {
  if (kept_bytes_ < kept_.size()) kept_[kept_bytes_++] = byte;
}

}  // namespace xr3
