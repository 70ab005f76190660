#include "tests/support/random_bytes.hpp"

#include <array>
#include <string_view>

namespace xr3::test {
namespace {

using std::string_view_literals::operator""sv;

constexpr std::array kEnds = {"\r"sv, "\n"sv, "\r\n"sv, "\r\0"sv, " "sv, ""sv};
constexpr std::array kTails = {"?"sv, "T"sv, "V"sv, "X"sv, "? T V"sv, "??"sv, "S"sv};
constexpr std::array kPlain = {"I"sv, "AI"sv, "J"sv, "K"sv, "L"sv, "M"sv, "N"sv, "O"sv, "Q"sv};
constexpr std::array kEnvironment = {
    "A#"sv, "A!!"sv, "A!1,2,-3!"sv, "A!1\r"sv, "A$"sv,   "A@"sv,     "A.12\r"sv, "A.\r"sv,
    "A|"sv, "A%3"sv, "A%9"sv,       "A**"sv,   "A*3*"sv, "A*1,2*"sv, "A*3\r"sv,  "A!0,0,0!"sv};
constexpr std::array kTelnet = {"\xff\xf4\xff\xfd\x06"sv,
                                "\xff\xfd\x03"sv,
                                "\xff\xfb\x01"sv,
                                "\xff\xfe\x01"sv,
                                "\xff\xff"sv,
                                "\xff"sv,
                                "\xff\xfa\x18\x00xterm\xff\xf0"sv,
                                "\xff\xf1"sv,
                                "\xff\xfb\x2c"sv,
                                "\xff\xfa\x2c\x07\xff\xf0"sv,
                                "\xff\xfa\x2c\x08\xff\xf0?FT\xff\xfa\x2c\x09\xff\xf0"sv,
                                "\xff\xfa"sv};

template <class List>
std::string any(RandomBytes& random, const List& list) {
  return std::string(list[random.below(static_cast<std::uint32_t>(list.size()))]);
}

}  // namespace

std::string RandomBytes::piece() {
  if (one_in(12)) return junk();
  if (one_in(20)) return telnet();
  return command();
}

std::string RandomBytes::stream(int pieces) {
  std::string bytes;
  for (int i = 0; i < pieces; ++i) bytes += piece();
  return bytes;
}

std::string RandomBytes::command() {
  std::string label(1, static_cast<char>('A' + below(8)));
  if (one_in(8)) label[0] = static_cast<char>(label[0] - 'A' + 'a');
  switch (below(12)) {
    case 0: return label + std::to_string(below(300)) + "S";
    case 1:
    case 2:
    case 3: return label + any(*this, kTails) + any(*this, kEnds);
    case 4: return any(*this, kPlain);
    case 5: return (one_in(2) ? "P" : "R") + std::to_string(below(10));
    case 6: return one_in(2) ? any(*this, kEnvironment) : "A$";
    default: return label + number() + any(*this, kEnds);
  }
}

std::string RandomBytes::number() {
  constexpr std::array kSigns = {"+"sv, "-"sv, ""sv};
  const std::uint32_t bound = one_in(6) ? 100'000 : 60;
  return any(*this, kSigns) + std::to_string(below(bound));
}

std::string RandomBytes::telnet() { return any(*this, kTelnet); }

std::string RandomBytes::junk() {
  std::string bytes;
  const std::uint32_t length = 1 + below(6);
  for (std::uint32_t i = 0; i < length; ++i) bytes.push_back(static_cast<char>(below(256)));
  return bytes;
}

}  // namespace xr3::test
