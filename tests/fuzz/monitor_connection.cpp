// Fuzzes a whole connection of the monitor port: detection of its protocol, HTTP with keep-alive,
// JSON lines, and handshakes of WebSocket, through the server's own connections
// (common/monitor_rig.hpp). Properties: the answers do not depend on how the bytes arrive; the
// server sends HTTP responses or lines of JSON; a connection ends when its client has ended; if
// reading requires the token, no message tells anything of the cell.
//
// Input: as in common/pieces.hpp.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/json/source.hpp"
#include "protocol/monitor/line_splitter.hpp"
#include "protocol/monitor/protocol_detector.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/fuzz/common/monitor_rig.hpp"
#include "tests/fuzz/common/pieces.hpp"

namespace xr3::fuzz {
namespace {

constexpr std::size_t kMaxTotal = 1024UL * 1024;  // four messages of the maximum size

bool waits(std::string_view whole) {
  monitor::ProtocolDetector detector;
  monitor::LineSplitter lines;
  lines.feed(whole.substr(detector.feed(whole)));
  lines.end();
  while (const auto line = lines.next()) {
    if (would_wait(*line)) return true;
  }
  return false;
}

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
    if (!line.starts_with(R"({"op":"result")") && !line.starts_with(R"({"op":"pong")") &&
        !line.starts_with(R"({"op":"bye")"))
      continue;
    require(Json::accept(line), "a message of the server is JSON");
    answers.push_back(line);
  }
  return answers;
}

void check(std::string_view in_pieces, std::string_view at_once) {
  constexpr std::string_view kUpgraded = "HTTP/1.1 101 ";
  // A client that sends frames before 101 is refused: this depends on the pieces.
  if (in_pieces.find(kUpgraded) != in_pieces.npos || at_once.find(kUpgraded) != at_once.npos)
    return;
  if (at_once.starts_with("HTTP/1.1 ") || at_once.empty())
    return require(without_numbers(in_pieces) == without_numbers(at_once),
                   "the responses to divided bytes");
  require(answers_in(in_pieces) == answers_in(at_once), "the answers to divided bytes");
}

/// The schema describes the cell's members, and the page uses them: only messages are checked.
void check_closed(std::string_view answer) {
  require(answer.starts_with("HTTP/1.1 ") || !shows_the_cell(answer), "reading needs the token");
}

}  // namespace

void run(std::string_view input) {
  const Pieces pieces = pieces_of(input, kMaxTotal);
  const std::string whole = joined(pieces);
  if (waits(whole)) return;
  check(MonitorRig::shared().converse(pieces), MonitorRig::shared().converse({whole}));
  check_closed(MonitorRig::closed().converse(pieces));
}

}  // namespace xr3::fuzz
