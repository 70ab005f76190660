#include "protocol/line/telnet_options.hpp"

#include <cassert>

#include "protocol/line/telnet_codes.hpp"

namespace xr3 {
namespace {

/// The bit of an accepted option; 0 for all others.
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
  return (options(side).on & bit_of(option)) != 0;
}

bool TelnetOptions::is_asked(Side side, std::uint8_t option) const {
  return (options(side).asked & bit_of(option)) != 0;
}

void TelnetOptions::ask(Side side, std::uint8_t option, std::string& requests) {
  assert(bit_of(option) != 0 && !is_on(side, option));
  options(side).asked |= bit_of(option);
  append(requests, side == Side::kPeer ? telnet::kDo : telnet::kWill, option);
}

void TelnetOptions::negotiate(std::uint8_t verb, std::uint8_t option, std::string& answers) {
  const Side side = verb == telnet::kWill || verb == telnet::kWont ? Side::kPeer : Side::kOwn;
  const bool wants_on = verb == telnet::kWill || verb == telnet::kDo;
  const std::uint8_t yes = side == Side::kPeer ? telnet::kDo : telnet::kWill;
  const std::uint8_t no = side == Side::kPeer ? telnet::kDont : telnet::kWont;
  if (verb == telnet::kDo && option == telnet::kTimingMark) return append(answers, yes, option);
  const bool is_an_answer = is_asked(side, option);
  if (is_an_answer) options(side).asked ^= bit_of(option);
  if (wants_on == is_on(side, option)) return;
  // An option that is not accepted has no bit: it stays off and is refused.
  options(side).on ^= bit_of(option);
  if (!is_an_answer) append(answers, is_on(side, option) ? yes : no, option);
}

}  // namespace xr3
