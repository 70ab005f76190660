#include "protocol/line/http_tls_detector.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;

/// The extent to which the first bytes match an opening.
enum class Match : std::uint8_t { kNone, kBeginning, kWhole };

Match match(std::string_view bytes, std::string_view greeting) {
  if (bytes.starts_with(greeting)) return Match::kWhole;
  return greeting.starts_with(bytes) ? Match::kBeginning : Match::kNone;
}

template <typename Greetings>
Match match_any(std::string_view bytes, const Greetings& greetings) {
  Match best = Match::kNone;
  for (const std::string_view greeting : greetings) best = std::max(best, match(bytes, greeting));
  return best;
}

// --- HTTP.

// The methods that a browser sends without a preflight request, and the others of RFC 9110 and
// 5789.
constexpr std::array kMethods = {"GET "sv,    "HEAD "sv,  "POST "sv,    "PUT "sv,    "PATCH "sv,
                                 "DELETE "sv, "TRACE "sv, "OPTIONS "sv, "CONNECT "sv};
// Beginnings of a target: a path, an absolute URL for a proxy, or `*` for the server itself.
constexpr std::array kTargets = {"/"sv, "http:"sv, "https:"sv, "ftp:"sv, "ws:"sv, "wss:"sv, "*"sv};
constexpr std::string_view kConnect = "CONNECT ";
constexpr std::size_t kMaxHost = HttpTlsDetector::kMaxHeld - kConnect.size();

// A page can choose most characters of a host name; browsers exclude these.
bool may_be_in_host(char byte) {
  return byte > ' ' && byte < '\x7f' && "#%/<>?@[\\]^|:"sv.find(byte) == std::string_view::npos;
}

// `host:port` up to the first digit of the port. For a host longer than kMaxHost the port is not
// required: no robot program begins with CONNECT and such a long word.
Match match_host_and_port(std::string_view target) {
  const std::string_view host = target.substr(0, target.find(':'));
  if (host.empty() || !std::all_of(host.begin(), host.end(), may_be_in_host)) return Match::kNone;
  if (host.size() > kMaxHost) return Match::kWhole;
  const std::string_view port = target.substr(host.size());
  if (port.size() < 2) return Match::kBeginning;
  return port[1] >= '0' && port[1] <= '9' ? Match::kWhole : Match::kNone;
}

// `[address]:port`, recognised by the first digit or colon of the address.
Match match_address_v6(std::string_view target) {
  constexpr std::string_view kBegins = "0123456789abcdefABCDEF:";
  if (!target.starts_with('[')) return Match::kNone;
  if (target.size() == 1) return Match::kBeginning;
  return kBegins.find(target[1]) == std::string_view::npos ? Match::kNone : Match::kWhole;
}

Match match_target(std::string_view method, std::string_view target) {
  if (target.empty()) return Match::kBeginning;
  const Match common = match_any(target, kTargets);
  if (method != kConnect) return common;
  return std::max({common, match_host_and_port(target), match_address_v6(target)});
}

Match match_request(std::string_view bytes) {
  for (const std::string_view method : kMethods) {
    if (bytes.starts_with(method)) return match_target(method, bytes.substr(method.size()));
  }
  return match_any(bytes, kMethods);
}

// --- Fixed openings.

constexpr std::array kFixed = {
    "PRI *"sv,                 // HTTP/2's preface
    "\x16\x03"sv,              // a TLS handshake record
    "\x80\x46\x01\x03\x01"sv,  // the SSL 2 hello that libwebrtc sends before ICE over "ssltcp"
};

// --- STUN and TURN: a type, the length after the header, the magic cookie.

constexpr std::string_view kCookie = "\x21\x12\xa4\x42";
constexpr std::size_t kCookieAt = 4;
constexpr std::size_t kHeader = 20;
// Low bytes of the possible first types: Binding, Allocate, ConnectionBind, Binding indication.
constexpr std::string_view kTypes = "\x01\x03\x0b\x11";
// Maximum high byte of a length: no message of a browser has 2048 bytes.
constexpr std::uint8_t kMaxLengthHigh = 7;

std::uint8_t byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint8_t>(bytes[at]);
}

// Whether one or two bytes may begin a length: below 2048 and a multiple of 4.
bool may_be_length(std::string_view bytes) {
  return byte_at(bytes, 0) <= kMaxLengthHigh && (bytes.size() < 2 || byte_at(bytes, 1) % 4 == 0);
}

Match match_message(std::string_view bytes) {
  if (bytes.empty()) return Match::kBeginning;
  if (bytes[0] != '\0') return Match::kNone;
  if (bytes.size() > 1 && kTypes.find(bytes[1]) == std::string_view::npos) return Match::kNone;
  if (bytes.size() > 2 && !may_be_length(bytes.substr(2, 2))) return Match::kNone;
  return bytes.size() > kCookieAt ? match(bytes.substr(kCookieAt), kCookie) : Match::kBeginning;
}

// A frame consists of a length in two bytes and a message.
Match match_frame(std::string_view bytes) {
  if (!may_be_length(bytes)) return Match::kNone;
  if (bytes.size() < 2) return Match::kBeginning;
  const std::size_t length = byte_at(bytes, 0) * 256U + byte_at(bytes, 1);
  if (length < kHeader) return Match::kNone;
  const std::size_t rest = length - kHeader;
  const std::array expected = {static_cast<char>(rest / 256), static_cast<char>(rest % 256)};
  const std::string_view message = bytes.substr(2);
  const std::string_view length_field = message.size() > 2 ? message.substr(2, 2) : ""sv;
  if (!std::string_view(expected.data(), expected.size()).starts_with(length_field))
    return Match::kNone;
  return match_message(message);
}

Match match_foreign_protocol(std::string_view bytes) {
  return std::max(
      {match_request(bytes), match_any(bytes, kFixed), match_message(bytes), match_frame(bytes)});
}

}  // namespace

Detection HttpTlsDetector::feed(std::uint8_t byte) {
  if (detection_ != Detection::kUndecided) return detection_;
  held_.push_back(static_cast<char>(byte));
  const Match found = match_foreign_protocol(held_);
  if (found == Match::kBeginning) return detection_;
  held_.pop_back();
  detection_ = found == Match::kWhole ? Detection::kNotARobotProgram : Detection::kPass;
  return detection_;
}

std::string HttpTlsDetector::release() { return std::exchange(held_, {}); }

}  // namespace xr3
