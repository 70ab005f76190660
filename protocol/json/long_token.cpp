#include "protocol/json/long_token.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "protocol/text/utf8.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kSample = 24;  // more than an escaped surrogate pair, the longest character

std::optional<unsigned> unit_at(std::string_view text, std::size_t at) {
  const std::string_view escape = text.substr(std::min(at, text.size()), 6);
  if (escape.size() < 6 || !escape.starts_with("\\u")) return std::nullopt;
  unsigned unit = 0;
  const auto read = std::from_chars(escape.data() + 2, escape.data() + 6, unit, 16);
  return read.ptr == escape.data() + 6 ? std::optional(unit) : std::nullopt;
}

std::size_t escape_length(std::string_view text, std::size_t at) {
  constexpr std::string_view kLetters = "\"\\/bfnrt";
  if (at + 1 < text.size() && kLetters.find(text[at + 1]) != std::string_view::npos) return 2;
  const auto unit = unit_at(text, at);
  if (!unit || (*unit >= 0xDC00 && *unit <= 0xDFFF)) return 0;
  if (*unit < 0xD800 || *unit > 0xDBFF) return 6;
  const auto second = unit_at(text, at + 6);
  return second && *second >= 0xDC00 && *second <= 0xDFFF ? 12 : 0;
}

/// Size of a character or escape sequence in a text, or 0 if it is invalid.
std::size_t letter_length(std::string_view text, std::size_t at) {
  if (text[at] == '\\') return escape_length(text, at);
  if (text[at] >= ' ' && text[at] <= '\x7F') return 1;
  return utf8_length(text.substr(at));
}

/// Checks the text from its opening quote to its closing quote, which may be missing.
std::optional<LongToken> wrong_text(std::string_view text, std::size_t begin, std::size_t end) {
  std::size_t at = begin + 1;
  while (at < end) {
    const std::size_t length = letter_length(text, at);
    if (length == 0) break;
    at += length;
  }
  if (at >= end && end < text.size()) return std::nullopt;
  return LongToken{begin, "\"" + std::string(text.substr(at, kSample)), at - 1};
}

std::optional<LongToken> wrong_number(std::string_view text, std::size_t begin, std::size_t end) {
  constexpr std::string_view kSameFault = "1e999";
  const std::string digits(text.substr(begin, end - begin));
  if (std::isfinite(std::strtod(digits.c_str(), nullptr))) return std::nullopt;
  return LongToken{begin, std::string(kSameFault), end - kSameFault.size()};
}

}  // namespace

std::size_t text_end(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] != '"') at += text[at] == '\\' ? 2 : 1;
  return std::min(at, text.size());
}

std::optional<LongToken> find_wrong_long_token(std::string_view text) {
  for (std::size_t begin = 0; begin < text.size();) {
    const bool is_text = text[begin] == '"';
    const std::size_t last =
        is_text ? text_end(text, begin + 1) : text.find_first_not_of("0123456789+-.eE", begin);
    const std::size_t end = std::min(last, text.size());
    if (end - begin > kLongToken) {
      auto wrong = is_text ? wrong_text(text, begin, end) : wrong_number(text, begin, end);
      if (wrong) return wrong;
    }
    begin = std::max(end, begin) + (is_text || end == begin ? 1 : 0);
  }
  return std::nullopt;
}

}  // namespace xr3
