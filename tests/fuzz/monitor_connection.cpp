// Fuzzes a whole connection of the monitor port: detection of its protocol, HTTP with keep-alive,
// JSON lines, and handshakes of WebSocket, through the server's own connections
// (common/monitor_rig.hpp). Properties: the server sends exactly the responses to the heads that a
// simple reading of the whole text finds, or an answer for each of its lines of JSON; they do not
// depend on how the bytes arrive; a connection ends when its client has ended; if reading requires
// the token, no message tells anything of the cell.
//
// Input: as in common/pieces.hpp. With kQuick there is one conversation, in pieces: of eight sizes
// of inputs, one is sent to the server that needs the token. With kFull there are three, also one
// with all bytes at once.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/json/source.hpp"
#include "protocol/monitor/line_splitter.hpp"
#include "protocol/monitor/protocol_detector.hpp"
#include "server/http/answer.hpp"
#include "server/http/wire.hpp"
#include "tests/fuzz/common/answers.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/fuzz/common/monitor_rig.hpp"
#include "tests/fuzz/common/pieces.hpp"

namespace xr3::fuzz::monitor_connection_fuzzer {
namespace {

constexpr std::size_t kMaxTotal = 384UL * 1024;  // one message of the maximum size, and more
constexpr std::size_t kMaxQuickRequests = 10;    // more only take time
constexpr std::size_t kClosedInterval = 8;

using monitor::Protocol;

/// The client's bytes, read as a whole.
struct Sent {
  Protocol protocol = Protocol::kUndecided;
  std::string_view bytes;  ///< of the protocol
  std::vector<std::string> lines;
  bool has_long_line = false;  ///< after them, longer than the maximum
};

Sent read(std::string_view whole) {
  monitor::ProtocolDetector detector;
  Sent sent;
  sent.bytes = whole.substr(detector.feed(whole));
  sent.protocol = detector.protocol();
  if (sent.protocol != Protocol::kLines) return sent;
  monitor::LineSplitter lines;
  lines.feed(sent.bytes);
  lines.end();
  while (const auto line = lines.next()) sent.lines.emplace_back(*line);
  sent.has_long_line = lines.fault() == monitor::LineFault::kTooLong;
  return sent;
}

// --- HTTP.

/// The metrics count connections, bytes and time: each number becomes one digit.
std::string without_numbers(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789";
  constexpr std::string_view kInNumber = "0123456789.e+-";
  std::string result;
  while (!text.empty()) {
    const std::size_t before = std::min(text.find_first_of(kDigits), text.size());
    result += text.substr(0, before);
    text.remove_prefix(before);
    if (!text.empty()) result += '0';
    text.remove_prefix(std::min(text.find_first_not_of(kInNumber), text.size()));
  }
  return result;
}

bool is_same_but_numbers(std::string_view a, std::string_view b) {
  return a == b || without_numbers(a) == without_numbers(b);
}

http::Answer answer_to(const http::HeadReading& head) {
  if (auto refused = http::refuse_head(head.fault)) return *std::move(refused);
  if (auto refused = MonitorRig::shared().resources().refuse(head.request))
    return *std::move(refused);
  if (!http::subprotocols_of(head.request.path()).empty())
    return *MonitorRig::shared().resources().refuse_websocket(head.request);
  return MonitorRig::shared().answer(head.request);
}

bool is_handshake(const http::HeadReading& head) {
  return head.fault == http::HeadFault::kNone &&
         !http::subprotocols_of(head.request.path()).empty() &&
         !MonitorRig::shared().resources().refuse(head.request) &&
         !MonitorRig::shared().resources().refuse_websocket(head.request);
}

/// The responses to the client's requests; nullopt after a handshake, whose answer depends on the
/// pieces: a client that sends frames before 101 is refused.
std::optional<std::string> responses_to(std::string_view bytes) {
  std::string responses;
  while (!bytes.empty()) {
    const http::HeadReading head = http::read_head(bytes);
    if (is_handshake(head)) return std::nullopt;
    http::Answer given = answer_to(head);
    if (head.request.then == http::Then::kClose) given.then = http::Then::kClose;
    responses += to_bytes(given, head.request.method);
    if (given.then == http::Then::kClose) break;
    bytes.remove_prefix(head.head_bytes);
    bytes.remove_prefix(std::min(bytes.find_first_not_of("\r\n"), bytes.size()));
  }
  return responses;
}

// --- Lines.

/// The answers to requests in the server's lines. How many messages of a channel lie between them
/// depends on time.
std::vector<std::string> answers_in(std::string_view lines) {
  std::vector<std::string> answers;
  while (!lines.empty()) {
    const std::size_t size = lines.find('\n');
    require(size != lines.npos, "the server's last line is complete");
    const std::string line(lines.substr(0, size));
    lines.remove_prefix(size + 1);
    require(line.starts_with(R"({"op":")"), "a message of the server has an op");
    if (!is_answer(line) && !line.starts_with(R"({"op":"bye")")) continue;
    require(Json::accept(line), "a message of the server is JSON");
    answers.push_back(line);
  }
  return answers;
}

void check_lines(const Sent& sent, std::string_view received) {
  const std::vector<std::string> answers = answers_in(received);
  const auto count = std::count_if(answers.begin(), answers.end(), is_answer);
  const std::size_t expected = answers_to(sent.lines) + (sent.has_long_line ? 1 : 0);
  require(static_cast<std::size_t>(count) == expected, "each line has its answer");
}

// --- All together.

void check(const Sent& sent, std::string_view received) {
  if (sent.protocol == Protocol::kTls) return require(received.empty(), "TLS gets no answer");
  if (sent.protocol != Protocol::kHttp) return check_lines(sent, received);
  const auto responses = responses_to(sent.bytes);
  require(!responses || is_same_but_numbers(received, *responses),
          "the responses to the requests of the whole text");
}

void check_divided(std::string_view in_pieces, std::string_view at_once) {
  constexpr std::string_view kUpgraded = "HTTP/1.1 101 ";
  // A client that sends frames before 101 is refused: this depends on the pieces.
  if (in_pieces.find(kUpgraded) != in_pieces.npos || at_once.find(kUpgraded) != at_once.npos)
    return;
  if (at_once.starts_with("HTTP/1.1 ") || at_once.empty())
    return require(is_same_but_numbers(in_pieces, at_once), "the responses to divided bytes");
  require(answers_in(in_pieces) == answers_in(at_once), "the answers to divided bytes");
}

/// The schema describes the cell's members, and the page uses them: only messages are checked.
void check_closed(const Pieces& pieces) {
  const std::string answer = MonitorRig::closed().converse(pieces);
  require(answer.starts_with("HTTP/1.1 ") || !shows_the_cell(answer), "reading needs the token");
}

void run(std::string_view input, Effort effort) {
  const bool is_full = effort == Effort::kFull;
  const Pieces pieces = pieces_of(input, effort, kMaxTotal);
  const std::string whole = joined(pieces);
  const Sent sent = read(whole);
  if (!is_full && sent.lines.size() > kMaxQuickRequests) return;
  if (std::any_of(sent.lines.begin(), sent.lines.end(), would_wait)) return;
  const bool is_closed = input.size() % kClosedInterval == 0;
  if (is_full || is_closed) check_closed(pieces);
  if (!is_full && is_closed) return;
  const std::string in_pieces = MonitorRig::shared().converse(pieces);
  check(sent, in_pieces);
  if (is_full) check_divided(in_pieces, MonitorRig::shared().converse({whole}));
}

const Registration kRegistration{{"monitor_connection", kMaxStreamInput, run}};

}  // namespace
}  // namespace xr3::fuzz::monitor_connection_fuzzer
