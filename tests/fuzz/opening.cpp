// Fuzzes how a connection of the monitor port begins: the detection of its protocol, and then the
// division of its bytes into lines. Properties: the answers agree with a simple reading of the
// whole text, and do not depend on how the bytes arrive; at most one line is held.
//
// Input: as in common/pieces.hpp.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/monitor/line_splitter.hpp"
#include "protocol/monitor/protocol_detector.hpp"
#include "protocol/monitor/request.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/fuzz/common/pieces.hpp"

namespace xr3::fuzz::opening_fuzzer {
namespace {

constexpr std::size_t kMaxTotal = 384UL * 1024;  // one line of the maximum length, and more

using monitor::kMaxMessageBytes;
using monitor::LineFault;
using monitor::LineSplitter;
using monitor::Protocol;
using monitor::ProtocolDetector;

constexpr std::string_view kBlanks = " \t\r\n";

std::string_view without_blanks(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(kBlanks), text.size()));
}

// --- The detector.

struct Opening {
  Protocol protocol = Protocol::kUndecided;
  std::size_t skipped = 0;
  bool operator==(const Opening&) const = default;
};

Opening opening_of(const Pieces& pieces, bool only_lines) {
  ProtocolDetector detector;
  if (only_lines) detector.settle_for_lines();
  Opening found;
  for (const std::string& piece : pieces) {
    if (detector.protocol() != Protocol::kUndecided) {
      require(detector.feed(piece) == 0, "nothing is skipped after the decision");
      continue;
    }
    const std::size_t skipped = detector.feed(piece);
    require(skipped <= piece.size(), "only received bytes are skipped");
    require(skipped == piece.size() || detector.protocol() != Protocol::kUndecided,
            "the detector holds no bytes");
    found.skipped += skipped;
  }
  found.protocol = detector.protocol();
  return found;
}

Protocol protocol_of(char first) {
  if (first == '{') return Protocol::kLines;
  if (first >= 'A' && first <= 'Z') return Protocol::kHttp;
  return first == '\x16' ? Protocol::kTls : Protocol::kNotJson;
}

/// The opening of the whole text: blanks around at most one byte order mark, then a byte.
Opening simple_opening(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  std::string_view rest = without_blanks(text);
  if (rest.starts_with(kMark)) rest = without_blanks(rest.substr(kMark.size()));
  if (rest.empty()) return {Protocol::kUndecided, text.size()};
  const bool is_in_mark = rest.size() < kMark.size() && kMark.starts_with(rest) &&
                          text.substr(0, text.size() - rest.size()).find(kMark) == text.npos;
  if (is_in_mark) return {Protocol::kUndecided, text.size()};
  return {protocol_of(rest[0]), text.size() - rest.size()};
}

void check_opening(const Pieces& pieces, std::string_view whole) {
  const Opening found = opening_of(pieces, false);
  require(found == opening_of({std::string(whole)}, false), "the opening in pieces and whole");
  const Opening simple = simple_opening(whole);
  require(found.protocol == simple.protocol, "the protocol of a simple reading");
  // The opening also skips an incomplete byte order mark. The text after it is then never JSON.
  require(found.skipped == simple.skipped || found.protocol == Protocol::kNotJson,
          "the skipped bytes of a simple reading");
  const Protocol after_hello = opening_of(pieces, true).protocol;
  require((after_hello == Protocol::kLines) == (found.protocol == Protocol::kLines),
          "lines are lines, before and after the greeting");
  require(after_hello != Protocol::kHttp && after_hello != Protocol::kTls,
          "after the greeting only lines are possible");
}

// --- The lines.

struct Lines {
  std::vector<std::string> lines;
  LineFault fault = LineFault::kNone;
  bool operator==(const Lines&) const = default;
};

void drain(LineSplitter& splitter, Lines& found) {
  while (const auto line = splitter.next()) {
    require(line->size() <= kMaxMessageBytes, "a line's size is bounded");
    require(line->starts_with('{'), "a line begins with {");
    require(line->find('\n') == line->npos, "a line has no line end");
    found.lines.emplace_back(*line);
  }
  found.fault = splitter.fault();
}

Lines lines_of(const Pieces& pieces) {
  LineSplitter splitter;
  Lines found;
  std::string held;  // at most what the splitter holds: all since the last line end
  for (const std::string& piece : pieces) {
    splitter.feed(piece);
    drain(splitter, found);
    held.append(piece).erase(0, held.rfind('\n') + 1);
    require(splitter.fault() != LineFault::kNone ||
                without_blanks(held).size() <= kMaxMessageBytes + std::string_view("\r").size(),
            "at most one line is held");
  }
  splitter.end();
  drain(splitter, found);
  return found;
}

Lines simple_lines(std::string_view text) {
  Lines found;
  for (text = without_blanks(text); !text.empty(); text = without_blanks(text)) {
    if (text[0] != '{') return {found.lines, LineFault::kNotJson};
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(line.size());
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.size() > kMaxMessageBytes) return {found.lines, LineFault::kTooLong};
    found.lines.emplace_back(line);
  }
  return found;
}

void run(std::string_view input, Effort effort) {
  const Pieces pieces = pieces_of(input, effort, kMaxTotal);
  const std::string whole = joined(pieces);
  check_opening(pieces, whole);
  const Lines simple = simple_lines(whole);
  require(lines_of(pieces) == simple, "the lines in pieces");
  require(lines_of({whole}) == simple, "the lines of the whole text");
}

const Registration kRegistration{{"opening", kMaxStreamInput, run}};

}  // namespace
}  // namespace xr3::fuzz::opening_fuzzer
