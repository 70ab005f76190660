#include "protocol/line/line_guard.hpp"

#include <algorithm>
#include <array>

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;

constexpr char kTelnetCommand = '\xff';
constexpr char kDelete = '\x7f';

// --- HTTP (RFC 9110, section 5.6.2, and RFC 9112, section 3).

constexpr std::array kUrlBeginnings = {"/"sv,      "http://"sv, "https://"sv,
                                       "ftp://"sv, "ws://"sv,   "wss://"sv};

bool is_letter_or_digit(char c) {
  return ('0' <= c && c <= '9') || ('A' <= c && c <= 'Z') || ('a' <= c && c <= 'z');
}

/// A character of a token, and so of a method.
bool is_in_method(char c) {
  return is_letter_or_digit(c) || "!#$%&'*+-.^_`|~"sv.find(c) != std::string_view::npos;
}

/// Whether the chunk begins with a method of any name, a blank and a target.
bool is_request(std::string_view chunk) {
  const auto method = static_cast<std::size_t>(
      std::find_if_not(chunk.begin(), chunk.end(), is_in_method) - chunk.begin());
  if (method > kMaxMethod) return true;
  if (method == 0 || method == chunk.size() || chunk[method] != ' ') return false;
  const std::string_view target = chunk.substr(method + 1);
  return std::any_of(kUrlBeginnings.begin(), kUrlBeginnings.end(),
                     [&](auto begin) { return target.starts_with(begin); });
}

// --- Binary protocols.

/// STUN's magic cookie, and the records of TLS and DTLS. A page chooses a part of the bytes before
/// and after them, but not these.
constexpr std::array kSignatures = {"\x21\x12\xa4\x42"sv, "\x16\x03\x00"sv, "\x16\x03\x01"sv,
                                    "\x16\x03\x02"sv,     "\x16\x03\x03"sv, "\x16\x03\x04"sv,
                                    "\x16\xfe\xfd"sv,     "\x16\xfe\xff"sv};

bool has_signature(std::string_view chunk) {
  return std::any_of(kSignatures.begin(), kSignatures.end(),
                     [&](auto sign) { return chunk.find(sign) != std::string_view::npos; });
}

bool is_text(char c) {
  return (c >= ' ' && c < kDelete) || c == '\r' || c == '\n' || c == '\t' || c == '\b';
}

/// Whether the chunk is neither text nor telnet. A telnet client may begin with commands, which
/// contain any bytes.
bool is_binary(std::string_view chunk) {
  return !chunk.starts_with(kTelnetCommand) && !std::all_of(chunk.begin(), chunk.end(), is_text);
}

}  // namespace

bool is_refused(std::string_view first_chunk, Guard guard) {
  if (guard == Guard::kOff) return false;
  if (is_request(first_chunk) || first_chunk.find("HTTP/") != std::string_view::npos) return true;
  if (!is_binary(first_chunk)) return false;
  return guard == Guard::kStrict || has_signature(first_chunk);
}

}  // namespace xr3
