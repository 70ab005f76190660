#include "server/http/wire.hpp"

#include <algorithm>
#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include "protocol/foxglove/wire.hpp"
#include "protocol/monitor/http_guard.hpp"
#include "protocol/text/text_stream.hpp"

namespace xr3::http {
namespace {

namespace beast = boost::beast;
using Parser = beast::http::request_parser<beast::http::string_body>;

constexpr std::array<std::string_view, 1> kMonitorSubprotocols{"xr3.v1"};
constexpr std::array<std::string_view, 1> kLineSubprotocols{"xr3.line.v1"};
constexpr std::string_view kLineEnd = "\r\n";
constexpr std::string_view kHeadEnd = "\r\n\r\n";
constexpr std::string_view kScheme = "http://";
constexpr unsigned kHttp11 = 11;

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// Whether a field continues on the next line. Beast would accept it; we refuse it.
bool has_folded_field(std::string_view head) {
  return head.find("\r\n ") != std::string_view::npos ||
         head.find("\r\n\t") != std::string_view::npos;
}

/// RFC 9112, section 3.2.2: the authority in a target of absolute form takes the place of Host.
void to_origin_form(HttpRequest& request) {
  const std::string_view target = request.target;
  if (!is_same_name(target.substr(0, kScheme.size()), kScheme)) return;
  const std::string_view rest = target.substr(kScheme.size());
  const std::string_view authority = rest.substr(0, rest.find_first_of("/?"));
  for (Field& field : request.fields)
    if (is_same_name(field.name, "Host")) field.value = authority;
  std::string path(rest.substr(authority.size()));
  if (!path.starts_with('/')) path.insert(path.begin(), '/');
  request.target = std::move(path);
}

HttpRequest request_of(const Parser& parser) {
  const auto& message = parser.get();
  HttpRequest request{std::string(view(message.method_string())),
                      std::string(view(message.target())),
                      {},
                      Then::kClose,
                      beast::websocket::is_upgrade(message)};
  for (const auto& field : message)
    request.fields.push_back(
        {std::string(view(field.name_string())), std::string(view(field.value()))});
  const bool has_body = message.count(beast::http::field::transfer_encoding) > 0 ||
                        parser.content_length().value_or(0) > 0;
  if (message.keep_alive() && !has_body) request.then = Then::kKeep;
  to_origin_form(request);
  return request;
}

HeadFault fault_of(const HttpRequest& request) {
  if (request.target.size() > kMaxTargetBytes) return HeadFault::kTargetTooLong;
  return request.fields.size() > kMaxFields ? HeadFault::kTooLarge : HeadFault::kNone;
}

/// Whether the request line has three words, the last one of the form HTTP/d.d.
bool names_a_version(std::string_view head) {
  constexpr std::string_view kForm = " HTTP/0.0";
  const std::string_view line = head.substr(0, head.find(kLineEnd));
  if (line.size() < kForm.size() || std::count(line.begin(), line.end(), ' ') != 2) return false;
  const std::string_view end = line.substr(line.size() - kForm.size());
  const auto is_alike = [](char c, char form) {
    return form == '0' ? '0' <= c && c <= '9' : c == form;
  };
  return std::equal(end.begin(), end.end(), kForm.begin(), is_alike);
}

HeadFault fault_of(const boost::system::error_code& error, std::string_view head) {
  const bool is_other_version = error == beast::http::error::bad_version && names_a_version(head);
  return is_other_version ? HeadFault::kVersion : HeadFault::kMalformed;
}

/// Parses a complete head, or a part of one to which the final empty line has been added.
HeadReading read_whole(std::string_view head) {
  if (has_folded_field(head)) return {HeadFault::kMalformed, {}, 0};
  Parser parser;
  parser.header_limit(2 * kMaxHeadBytes);  // never reached: we check our own limit before
  parser.body_limit(boost::none);
  boost::system::error_code error;
  parser.put(boost::asio::buffer(head), error);
  if (error || !parser.is_header_done()) return {fault_of(error, head), {}, 0};
  HeadReading reading{HeadFault::kNone, request_of(parser), head.size()};
  reading.fault = fault_of(reading.request);
  return reading;
}

/// The fault of a head that exceeds the size limit. `is_first`: it ends within its first line.
HeadFault unended(std::string_view line, bool is_first) {
  const std::size_t target = is_first ? line.find(' ') : std::string_view::npos;
  const bool has_long_target =
      target != std::string_view::npos && line.size() - target > kMaxTargetBytes;
  return has_long_target ? HeadFault::kTargetTooLong : HeadFault::kTooLarge;
}

/// The fault of complete lines, which may be followed by more.
HeadFault fault_of_lines(std::string_view lines) {
  return read_whole(std::string(lines).append(kLineEnd)).fault;
}

/// The fault of the first lines that have one, so that it does not depend on how the bytes arrive.
HeadFault first_fault(std::string_view lines) {
  HeadFault fault = HeadFault::kNone;
  for (std::size_t end = 0; fault == HeadFault::kNone && end < lines.size();) {
    end = lines.find('\n', end) + 1;
    fault = fault_of_lines(lines.substr(0, end));
  }
  return fault;
}

/// A fault in the lines that are complete; detected before the rest of the head arrives.
HeadFault fault_so_far(std::string_view received) {
  const std::string_view lines = received.substr(0, received.rfind('\n') + 1);
  if (lines.empty() || fault_of_lines(lines) == HeadFault::kNone) return HeadFault::kNone;
  return first_fault(lines);
}

int hexadecimal(char c) {
  if ('0' <= c && c <= '9') return c - '0';
  if ('a' <= c && c <= 'f') return c - 'a' + 10;
  return 'A' <= c && c <= 'F' ? c - 'A' + 10 : -1;
}

/// Percent-decodes; empty if an escape is invalid.
std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      result += text[i] == '+' ? ' ' : text[i];
      continue;
    }
    const int high = i + 2 < text.size() ? hexadecimal(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? hexadecimal(text[i + 2]) : -1;
    if (high < 0 || low < 0) return {};
    result += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return result;
}

}  // namespace

std::vector<std::string_view> HttpRequest::values(std::string_view name) const {
  std::vector<std::string_view> found;
  for (const Field& field : fields) {
    if (is_same_name(field.name, name)) found.push_back(field.value);
  }
  return found;
}

std::span<const std::string_view> subprotocols_of(std::string_view path) {
  if (path == kMonitorPath) return kMonitorSubprotocols;
  if (path == kLinePath) return kLineSubprotocols;
  if (path == kFoxglovePath) return foxglove::kSubprotocols;
  return {};
}

std::string_view subprotocol_for(const HttpRequest& request) {
  const auto known = subprotocols_of(request.path());
  const auto offers = request.values("Sec-WebSocket-Protocol");
  if (known.empty() || offers.empty()) return known.empty() ? std::string_view() : known.front();
  const auto is_offered = [&](std::string_view name) {
    return std::ranges::any_of(offers, [&](std::string_view list) {
      return boost::beast::http::token_list(list).exists(name);
    });
  };
  const auto found = std::ranges::find_if(known, is_offered);
  return found == known.end() ? std::string_view() : *found;
}

std::string_view HttpRequest::path() const {
  return std::string_view(target).substr(0, target.find('?'));
}

std::optional<std::string> HttpRequest::parameter(std::string_view name) const {
  std::string_view rest = std::string_view(target).substr(path().size());
  while (!rest.empty()) {
    rest.remove_prefix(1);  // ? or &
    const std::string_view pair = rest.substr(0, rest.find('&'));
    rest.remove_prefix(pair.size());
    const std::size_t equals = std::min(pair.find('='), pair.size());
    if (pair.substr(0, equals) != name) continue;
    return decoded(pair.substr(std::min(equals + 1, pair.size())));
  }
  return std::nullopt;
}

HeadReading read_head(std::string_view received) {
  const std::string_view head = received.substr(0, kMaxHeadBytes);
  const std::size_t end = head.find(kHeadEnd);
  if (end != std::string_view::npos) {
    HeadReading reading = read_whole(head.substr(0, end + kHeadEnd.size()));
    if (reading.fault != HeadFault::kNone)
      reading.fault = first_fault(head.substr(0, end + kLineEnd.size()));
    return reading;
  }
  if (const HeadFault fault = fault_so_far(head); fault != HeadFault::kNone) return {fault, {}, 0};
  if (received.size() < kMaxHeadBytes) return {HeadFault::kIncomplete, {}, 0};
  return {unended(head, head.find('\n') == std::string_view::npos), {}, 0};
}

std::string head_text(unsigned status, const std::vector<Field>& fields, std::size_t body_bytes,
                      Then then) {
  beast::http::response_header<> head;
  head.version(kHttp11);
  head.result(status);
  for (const Field& field : fields) head.insert(field.name, field.value);
  head.set(beast::http::field::content_length, std::to_string(body_bytes));
  for (const Field& field : safety_fields())
    if (head.count(field.name) == 0) head.insert(field.name, field.value);
  head.insert(beast::http::field::connection, then == Then::kKeep ? "keep-alive" : "close");
  TextStream text;
  text << head;
  return text.str();
}

std::string page_policy(const std::vector<std::string>& frame_origins) {
  std::string ancestors = frame_origins.empty() ? " 'none'" : "";
  for (const std::string& origin : frame_origins) ancestors += " " + origin;
  return "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; "
         "frame-ancestors" +
         ancestors + "; base-uri 'none'";
}

const std::vector<Field>& safety_fields() {
  static const std::vector<Field> fields{
      {"Cache-Control", "no-store"},
      {"X-Content-Type-Options", "nosniff"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Content-Security-Policy", "default-src 'self'; frame-ancestors 'none'; base-uri 'none'"}};
  return fields;
}

}  // namespace xr3::http
