#include "protocol/text/printable.hpp"

#include <algorithm>
#include <array>

namespace xr3 {
namespace {

struct CodeRange {
  char32_t first;
  char32_t last;
};
/// Unprintable characters of more than one byte: C1, those of direction and of line ends, and
/// noncharacters.
constexpr std::array<CodeRange, 6> kUnprintable{{{0x80, 0x9F},
                                                 {0x61C, 0x61C},
                                                 {0x200E, 0x200F},
                                                 {0x2028, 0x202E},
                                                 {0x2066, 0x2069},
                                                 {0xFFFE, 0xFFFF}}};

bool is_between(std::string_view text, std::size_t at, unsigned low, unsigned high) {
  const auto byte = at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
  return low <= byte && byte <= high;
}

/// Size of the character outside ASCII at the start of a text (RFC 3629), or 0 if there is none or
/// it is invalid.
std::size_t utf8_length(std::string_view text) {
  struct Utf8Form {
    unsigned first_low, first_high, second_low, second_high;
    std::size_t length;
  };
  constexpr Utf8Form kForms[] = {{0xC2, 0xDF, 0x80, 0xBF, 2}, {0xE0, 0xE0, 0xA0, 0xBF, 3},
                                 {0xE1, 0xEC, 0x80, 0xBF, 3}, {0xED, 0xED, 0x80, 0x9F, 3},
                                 {0xEE, 0xEF, 0x80, 0xBF, 3}, {0xF0, 0xF0, 0x90, 0xBF, 4},
                                 {0xF1, 0xF3, 0x80, 0xBF, 4}, {0xF4, 0xF4, 0x80, 0x8F, 4}};
  for (const Utf8Form& form : kForms) {
    if (!is_between(text, 0, form.first_low, form.first_high)) continue;
    bool is_good = is_between(text, 1, form.second_low, form.second_high);
    for (std::size_t i = 2; i < form.length; ++i)
      is_good = is_good && is_between(text, i, 0x80, 0xBF);
    return is_good ? form.length : 0;
  }
  return 0;
}

/// The code point of a valid character.
char32_t code_point(std::string_view character) {
  if (character.size() == 1) return static_cast<unsigned char>(character[0]);
  char32_t code = static_cast<unsigned char>(character[0]) & (0x7FU >> character.size());
  for (const char byte : character.substr(1))
    code = code << 6U | (static_cast<unsigned char>(byte) & 0x3FU);
  return code;
}

/// Whether a character outside printable ASCII is printable. A single byte is not.
bool is_printable(std::string_view character) {
  const char32_t code = code_point(character);
  const auto contains = [code](const CodeRange& range) {
    return code >= range.first && code <= range.last;
  };
  return character.size() > 1 && std::none_of(kUnprintable.begin(), kUnprintable.end(), contains);
}

std::string hex_digits(char32_t number, int count) {
  std::string digits;
  for (int shift = 4 * (count - 1); shift >= 0; shift -= 4)
    digits += "0123456789abcdef"[number >> static_cast<unsigned>(shift) & 0xFU];
  return digits;
}

std::string escaped_bytes(std::string_view character) {
  std::string text;
  for (const char byte : character) text += "\\x" + hex_digits(static_cast<unsigned char>(byte), 2);
  return text;
}

std::string escaped_code(std::string_view character) {
  return "\\u" + hex_digits(code_point(character), 4);
}

/// The text with `escape(character)` in place of each character that is not printable.
std::string without_unprintable(std::string_view text, bool keeps_lines,
                                std::string (*escape)(std::string_view)) {
  const auto is_plain = [keeps_lines](char c) {
    return (c >= ' ' && c < '\x7F') || (keeps_lines && (c == '\n' || c == '\t'));
  };
  std::string result;
  while (!text.empty()) {
    const auto plain_end = std::find_if_not(text.begin(), text.end(), is_plain);
    const auto plain = static_cast<std::size_t>(plain_end - text.begin());
    result += text.substr(0, plain);
    text.remove_prefix(plain);
    const std::size_t length = std::min(text.size(), std::max<std::size_t>(1, utf8_length(text)));
    const std::string_view character = text.substr(0, length);
    if (!character.empty()) result += is_printable(character) ? character : escape(character);
    text.remove_prefix(length);
  }
  return result;
}

}  // namespace

std::string printable_line(std::string_view text) {
  return without_unprintable(text, false, escaped_bytes);
}

std::string printable_lines(std::string_view text) {
  return without_unprintable(text, true, escaped_bytes);
}

std::string printable_json(std::string_view json) {
  return without_unprintable(json, true, escaped_code);
}

}  // namespace xr3
