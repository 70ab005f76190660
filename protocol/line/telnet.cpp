#include "protocol/line/telnet.hpp"

namespace xr3 {
namespace {

enum Telnet : std::uint8_t {
  kSe = 0xf0,
  kInterrupt = 0xf4,
  kSb = 0xfa,
  kWill = 0xfb,
  kWont = 0xfc,
  kDo = 0xfd,
  kDont = 0xfe,
  kIac = 0xff,
};
constexpr std::uint8_t kMinCommand = kSe;
constexpr std::uint8_t kTimingMark = 6;

void append(std::string& out, std::uint8_t verb, std::uint8_t option) {
  for (const std::uint8_t byte : {std::uint8_t{kIac}, verb, option}) {
    out.push_back(static_cast<char>(byte));
  }
}

}  // namespace

std::optional<std::uint8_t> TelnetFilter::feed(std::uint8_t byte, std::string& answers) {
  switch (mode_) {
    case Mode::kData:
      if (byte != kIac) return byte;
      mode_ = Mode::kCommand;
      return std::nullopt;
    case Mode::kCommand: return feed_command(byte);
    case Mode::kOption: feed_option(byte, answers); return std::nullopt;
    default: feed_subnegotiation(byte); return std::nullopt;
  }
}

// The byte after IAC. If it is not a telnet command, it is data, and only the FF is lost.
std::optional<std::uint8_t> TelnetFilter::feed_command(std::uint8_t byte) {
  mode_ = Mode::kData;
  if (byte < kMinCommand || byte == kIac) return byte;
  if (byte == kInterrupt) is_telnet_ = true;
  if (byte == kSb) {
    mode_ = Mode::kSubnegotiation;
    length_ = 0;
  } else if (byte >= kWill) {
    mode_ = Mode::kOption;
    verb_ = byte;
  }
  return std::nullopt;
}

void TelnetFilter::feed_option(std::uint8_t option, std::string& answers) {
  mode_ = Mode::kData;
  is_telnet_ = true;
  if (verb_ == kWill) append(answers, kDont, option);
  if (verb_ == kDo) append(answers, option == kTimingMark ? kWill : kWont, option);
}

void TelnetFilter::feed_subnegotiation(std::uint8_t byte) {
  const bool is_end = mode_ == Mode::kSubnegotiationCommand && byte == kSe;
  const bool begins_command = mode_ == Mode::kSubnegotiation && byte == kIac;
  mode_ = begins_command ? Mode::kSubnegotiationCommand : Mode::kSubnegotiation;
  is_telnet_ |= is_end;
  if (is_end || (!begins_command && ++length_ > kMaxSubnegotiationBytes)) mode_ = Mode::kData;
}

void TelnetFilter::encode(std::string_view replies, std::string& out) const {
  if (!is_telnet_) {  // a picture comes by the hundred kilobytes
    out.append(replies);
    return;
  }
  for (const char reply : replies) {
    out.push_back(reply);
    if (static_cast<std::uint8_t>(reply) == kIac) out.push_back(reply);
  }
}

}  // namespace xr3
