#include "protocol/line/telnet_options.hpp"

#include "protocol/line/telnet_codes.hpp"

namespace xr3 {
namespace {

/// The bit of an accepted option; 0 for the others.
std::uint8_t bit_of(std::uint8_t option) {
  switch (option) {
    case telnet::kBinary: return 1;
    case telnet::kSuppressGoAhead: return 2;
    case telnet::kComPort: return 4;
    default: return 0;
  }
}

void append(std::string& out, std::uint8_t verb, std::uint8_t option) {
  for (const std::uint8_t byte : {telnet::kIac, verb, option}) {
    out.push_back(static_cast<char>(byte));
  }
}

}  // namespace

bool TelnetOptions::is_on(Side side, std::uint8_t option) const {
  return (states(side) & bit_of(option)) != 0;
}

void TelnetOptions::negotiate(std::uint8_t verb, std::uint8_t option, std::string& answers) {
  const Side side = verb == telnet::kWill || verb == telnet::kWont ? Side::kClient : Side::kServer;
  const bool wants_on = verb == telnet::kWill || verb == telnet::kDo;
  const std::uint8_t yes = side == Side::kClient ? telnet::kDo : telnet::kWill;
  const std::uint8_t no = side == Side::kClient ? telnet::kDont : telnet::kWont;
  if (verb == telnet::kDo && option == telnet::kTimingMark) return append(answers, yes, option);
  if (wants_on == is_on(side, option)) return;
  // An option that is not accepted has no bit: it stays off and is refused.
  states(side) ^= bit_of(option);
  append(answers, is_on(side, option) ? yes : no, option);
}

}  // namespace xr3
