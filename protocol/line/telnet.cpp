#include "protocol/line/telnet.hpp"

#include <span>

#include "protocol/line/telnet_codes.hpp"

namespace xr3 {

using enum TelnetOptions::Side;

TelnetInput TelnetFilter::feed(std::uint8_t byte, std::string& answers) {
  switch (mode_) {
    case Mode::kData:
      if (byte != telnet::kIac) return {byte};
      mode_ = Mode::kCommand;
      return {};
    case Mode::kCommand: return {feed_command(byte)};
    case Mode::kOption: return {std::nullopt, feed_option(byte, answers)};
    default: return {std::nullopt, feed_subnegotiation(byte, answers)};
  }
}

bool TelnetFilter::is_data(std::uint8_t byte) const {
  if (mode_ == Mode::kData) return byte != telnet::kIac;
  return mode_ == Mode::kCommand && (byte < telnet::kSe || byte == telnet::kIac);
}

// The byte after IAC. If it is not a telnet command, it is data, and only the FF is lost.
std::optional<std::uint8_t> TelnetFilter::feed_command(std::uint8_t byte) {
  const bool is_byte_of_data = is_data(byte);
  mode_ = Mode::kData;
  if (is_byte_of_data) return byte;
  if (byte == telnet::kInterrupt) is_telnet_ = true;
  if (byte == telnet::kSb) {
    mode_ = Mode::kSubnegotiation;
    length_ = 0;
    kept_bytes_ = 0;
  } else if (byte >= telnet::kWill) {
    mode_ = Mode::kOption;
    verb_ = byte;
  }
  return std::nullopt;
}

// After COM-PORT has been switched off, no RESUME can come.
ReplyControl TelnetFilter::feed_option(std::uint8_t option, std::string& answers) {
  mode_ = Mode::kData;
  is_telnet_ = true;
  const bool had_com_port = has_com_port();
  const bool client_had_it = options_.is_on(kClient, telnet::kComPort);
  options_.negotiate(verb_, option, answers);
  const bool client_has_it = options_.is_on(kClient, telnet::kComPort);
  if (client_has_it && !client_had_it) ComPort::append_modem_state(answers);
  return had_com_port && !has_com_port() ? ReplyControl::kResume : ReplyControl::kNone;
}

ReplyControl TelnetFilter::feed_subnegotiation(std::uint8_t byte, std::string& answers) {
  const bool is_after_iac = mode_ == Mode::kSubnegotiationCommand;
  if (!is_after_iac && byte == telnet::kIac) {
    mode_ = Mode::kSubnegotiationCommand;
    return ReplyControl::kNone;
  }
  mode_ = Mode::kSubnegotiation;
  if (is_after_iac && byte == telnet::kSe) return end_subnegotiation(answers);
  if (!is_after_iac || byte == telnet::kIac) keep(byte);
  if (++length_ > kMaxSubnegotiationBytes) mode_ = Mode::kData;
  return ReplyControl::kNone;
}

void TelnetFilter::keep(std::uint8_t byte) {
  if (kept_bytes_ < kept_.size()) kept_[kept_bytes_++] = byte;
}

ReplyControl TelnetFilter::end_subnegotiation(std::string& answers) {
  mode_ = Mode::kData;
  is_telnet_ = true;
  const bool is_request = kept_bytes_ > 0 && kept_[0] == telnet::kComPort && has_com_port();
  if (!is_request) return ReplyControl::kNone;
  return com_port_.handle(std::span(kept_).first(kept_bytes_).subspan(1), answers);
}

bool TelnetFilter::has_com_port() const {
  return options_.is_on(kClient, telnet::kComPort) || options_.is_on(kServer, telnet::kComPort);
}

std::optional<SerialSettings> TelnetFilter::settings() const {
  return has_com_port() ? std::optional(com_port_.settings()) : std::nullopt;
}

void TelnetFilter::encode(std::string_view replies, std::string& out) const {
  if (!is_telnet_) {  // a picture comes by the hundred kilobytes
    out.append(replies);
    return;
  }
  for (const char reply : replies) {
    out.push_back(reply);
    if (static_cast<std::uint8_t>(reply) == telnet::kIac) out.push_back(reply);
  }
}

}  // namespace xr3
