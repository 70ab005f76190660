// Fuzzes HTTP without a connection: heads of requests, the guard against pages of other sites, and
// the answers. Properties: the reading of a head does not depend on how its bytes arrive; an
// accepted head is within the limits, means the same when it is written again, and names nothing
// but this machine as its host; every answer is one well-formed response; without the token only
// what is public is answered.
//
// Input: as in common/pieces.hpp. With kQuick, only the hosts and origins of a request are checked
// by the guard, only short bodies for their form, and the server that needs the token is asked only
// if the input has an even size.
#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/json/source.hpp"
#include "protocol/monitor/http_guard.hpp"
#include "server/http/answer.hpp"
#include "server/http/wire.hpp"
#include "server/resources/sites.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/fuzz/common/monitor_rig.hpp"
#include "tests/fuzz/common/pieces.hpp"

namespace xr3::fuzz::http_fuzzer {
namespace {

constexpr std::size_t kMaxTotal = 64UL * 1024;  // four heads of the maximum size

using http::Field;
using http::HeadFault;
using http::HeadReading;
using http::HttpRequest;
using http::read_head;

constexpr std::string_view kLineEnd = "\r\n";
constexpr std::string_view kHeadEnd = "\r\n\r\n";

bool is_same(const HttpRequest& a, const HttpRequest& b) {
  const auto is_same_field = [](const Field& x, const Field& y) {
    return x.name == y.name && x.value == y.value;
  };
  return a.method == b.method && a.target == b.target && a.then == b.then &&
         a.is_upgrade == b.is_upgrade &&
         std::equal(a.fields.begin(), a.fields.end(), b.fields.begin(), b.fields.end(),
                    is_same_field);
}

bool is_same(const HeadReading& a, const HeadReading& b) {
  return a.fault == b.fault && a.head_bytes == b.head_bytes &&
         (a.fault != HeadFault::kNone || is_same(a.request, b.request));
}

// --- The bytes in pieces.

/// The reading after each piece, until it is decided.
HeadReading read_pieces(const Pieces& pieces) {
  std::string received;
  HeadReading reading = read_head(received);
  for (const std::string& piece : pieces) {
    received += piece;
    reading = read_head(received);
    if (reading.fault != HeadFault::kIncomplete) break;
  }
  return reading;
}

void check_pieces(const Pieces& pieces, const HeadReading& whole) {
  require(is_same(read_pieces(pieces), whole), "a head in pieces and whole");
}

// --- Accepted heads.

bool has_control_character(std::string_view text) {
  return std::any_of(text.begin(), text.end(),
                     [](unsigned char c) { return c < 0x20 && c != '\t'; });
}

void check_limits(const HeadReading& reading, std::string_view head) {
  require(reading.head_bytes <= http::kMaxHeadBytes, "a head's size is bounded");
  require(head.find(kHeadEnd) + kHeadEnd.size() == head.size(), "a head ends at its empty line");
  const HttpRequest& request = reading.request;
  require(request.target.size() <= http::kMaxTargetBytes, "a target's size is bounded");
  require(request.fields.size() <= http::kMaxFields, "the number of fields is bounded");
  require(!request.method.empty() && !request.target.empty(), "a request has method and target");
  require(!has_control_character(request.method + request.target), "a request line is text");
  require(request.target.find(' ') == std::string::npos, "a target has no blanks");
  for (const Field& field : request.fields) {
    require(!field.name.empty() && !has_control_character(field.name + field.value),
            "a field is text");
    require(field.name.find_first_of(" \t:") == std::string::npos, "a field's name is a token");
  }
}

/// The request with one blank or colon and blank between its parts.
std::string written(const HttpRequest& request, std::string_view version) {
  std::string head = request.method + " " + request.target + " " + std::string(version) + "\r\n";
  for (const Field& field : request.fields) head += field.name + ": " + field.value + "\r\n";
  return head + "\r\n";
}

void check_accepted(const HeadReading& reading, std::string_view received) {
  const std::string_view head = received.substr(0, reading.head_bytes);
  check_limits(reading, head);
  require(is_same(read_head(head), reading), "what follows a head does not change it");
  const std::string_view line = head.substr(0, head.find(kLineEnd));
  const std::string_view version = line.substr(line.rfind(' ') + 1);
  require(version == "HTTP/1.0" || version == "HTTP/1.1", "an accepted version");
  const HeadReading again = read_head(written(reading.request, version));
  require(again.fault != HeadFault::kNone || is_same(again.request, reading.request),
          "a head written and read again");
  // Blanks after a colon are optional: the written head may be longer than the limit.
  require(again.fault == HeadFault::kNone || again.fault == HeadFault::kTooLarge ||
              again.fault == HeadFault::kTargetTooLong,
          "a head that is written again is accepted");
}

// --- Queries.

std::string percent_encoded(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string encoded;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    encoded += {'%', kDigits[byte / 16], kDigits[byte % 16]};
  }
  return encoded;
}

void check_query(std::string_view text) {
  HttpRequest request;
  request.target = "/view.svg?a=1&vector=" + percent_encoded(text) + "&vector=x";
  require(request.path() == "/view.svg", "the path ends at the query");
  require(request.parameter("vector") == text, "a query parameter encoded and decoded");
  require(!request.parameter("cell"), "an absent parameter");
}

// --- The guard.

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

/// Whether no name server is asked for a host, because of its last label: a number, `localhost` or
/// a closing bracket.
bool needs_no_name_server(std::string_view host) {
  if (host.starts_with('[')) return host.find(']') != host.npos;
  const std::string_view name = host.substr(0, host.find(':'));
  const std::string last = upper(name.substr(name.rfind('.') + 1));
  return last == "LOCALHOST" ||
         (!last.empty() && last.find_first_not_of("0123456789") == last.npos);
}

void check_guard(std::string_view host) {
  const http::GuardRules strict;
  const http::GuardRules beyond{http::HostReach::kBeyond, {}, {}};
  const bool is_allowed = http::is_host_allowed(host, strict);
  require(is_allowed == http::is_local_host(host), "without rules only local hosts are allowed");
  require(!is_allowed || http::is_host_allowed(host, beyond), "a wider reach allows more");
  require(!is_allowed || needs_no_name_server(host), "no name server resolves an allowed host");
  require(is_allowed == http::is_host_allowed(upper(host), strict), "hosts ignore the case");
  require(!http::is_host_allowed(host, beyond) || is_allowed || host.find('.') == host.npos,
          "a wider reach allows names of one label");
  const http::GuardRules rules{
      http::HostReach::kThisMachine, {std::string(host)}, {std::string(host)}};
  require(!http::is_host_name(host) || http::is_host_allowed(host, rules), "a rule's host");
  require(http::is_origin_allowed(host, "localhost", rules), "a rule's origin");
  require(!http::is_origin_allowed("null", host, strict), "the origin null");
  require(http::is_origin_allowed("http://" + std::string(host), host, strict), "the own origin");
  require(!http::is_origin_allowed("https://" + std::string(host), host, strict),
          "an origin of another scheme");
  require(!http::is_origin(host) || host.find('/', 8) == host.npos, "an origin has no path");
}

bool is_guarded(const Field& field) {
  const std::string name = upper(field.name);
  return name == "HOST" || name == "ORIGIN";
}

// --- Answers.

/// Whether a response has its own value of this field: a site has a policy of its own.
bool has_own(const http::Answer& answer, std::string_view name) {
  return std::ranges::any_of(answer.fields, [name](const Field& own) { return own.name == name; });
}

void check_response(const http::Answer& answer, std::string_view method, Effort effort) {
  constexpr std::size_t kShort = 1024;
  const std::string all_bytes = to_bytes(answer, method);
  const std::string_view bytes = all_bytes;
  const std::size_t end = bytes.find(kHeadEnd);
  require(bytes.starts_with("HTTP/1.1 ") && end != std::string::npos, "a response has a head");
  const std::string_view head = bytes.substr(0, end + kLineEnd.size());
  const std::string_view body = bytes.substr(end + kHeadEnd.size());
  require(body == (method == "HEAD" ? "" : answer.body.bytes()), "a response ends with its body");
  require(!has_control_character(answer.type), "a content type is text");
  const auto has = [&](const std::string& line) {
    return head.find("\r\n" + line + "\r\n") != std::string::npos;
  };
  require(has("Content-Length: " + std::to_string(answer.body.bytes().size())),
          "a response has a length");
  for (const Field& field : http::safety_fields())
    require(has(field.name + ": " + field.value) || has_own(answer, field.name),
            "a response has the safety fields");
  require(std::count(head.begin(), head.end(), '\r') == std::count(head.begin(), head.end(), '\n'),
          "the lines of a response end with CR LF");
  const bool is_checked = effort == Effort::kFull || answer.body.bytes().size() <= kShort;
  if (is_checked && answer.type == "application/json")
    require(Json::accept(answer.body.bytes()), "the body of a response is JSON");
}

/// Without the token, only health checks, the page, the sites, the schema and errors are answered.
void check_closed(const HttpRequest& request) {
  const http::Answer answer = MonitorRig::closed().answer(request);
  const std::string_view path = request.path();
  const bool is_page = path == "/" || path == "/favicon.ico" || path.starts_with("/assets/") ||
                       path.starts_with("/cell/") || Sites::has(path);
  const bool is_open = path == "/healthz" || path == "/readyz" || path == "/schema/v1.json" ||
                       path == "/sites";
  require(answer.status >= 400 || is_page || is_open, "reading needs the token");
}

void check_answers(const HeadReading& reading, Effort effort, bool asks_closed) {
  auto refused = http::refuse_head(reading.fault);
  require(refused.has_value() == (reading.fault != HeadFault::kNone), "a fault is answered");
  if (!refused) refused = MonitorRig::shared().resources().refuse(reading.request);
  if (refused) {
    require(refused->status >= 400, "a refusal has a status of an error");
    return check_response(*refused, reading.request.method, effort);
  }
  if (auto no_websocket = MonitorRig::shared().resources().refuse_websocket(reading.request))
    check_response(*no_websocket, reading.request.method, effort);
  const http::Answer answer = MonitorRig::shared().answer(reading.request);
  check_response(answer, reading.request.method, effort);
  if (asks_closed) check_closed(reading.request);
  require(reading.request.values("Host").size() == 1 &&
              http::is_local_host(reading.request.values("Host").front()),
          "only a request to this machine is answered");
}

void run(std::string_view input, Effort effort) {
  constexpr std::size_t kMaxHost = 80;
  const Pieces pieces = pieces_of(input, effort, kMaxTotal);
  const std::string whole = joined(pieces);
  const HeadReading reading = read_head(whole);
  check_pieces(pieces, reading);
  if (reading.fault == HeadFault::kNone) check_accepted(reading, whole);
  check_answers(reading, effort, effort == Effort::kFull || input.size() % 2 == 0);
  for (const Field& field : reading.request.fields) {
    if (effort == Effort::kFull || is_guarded(field)) check_guard(field.value);
  }
  const std::string_view host = std::string_view(whole).substr(0, kMaxHost);
  check_guard(host);
  check_query(host);
}

const Registration kRegistration{{"http", kMaxStreamInput, run}};

}  // namespace
}  // namespace xr3::fuzz::http_fuzzer
