#include "tests/support/transcript.hpp"

#include <charconv>
#include <map>
#include <stdexcept>

#include "protocol/explain/diagnostic.hpp"
#include "tests/support/models.hpp"
#include "tests/support/wire.hpp"

namespace xr3::test {
namespace {

[[noreturn]] void refuse(const std::string& file, int line, const std::string& why) {
  throw std::runtime_error(file + ":" + std::to_string(line) + ": " + why);
}

// --- Reading.

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  throw std::invalid_argument("\\x wants two hexadecimal digits in small letters");
}

// Decodes the escape sequence whose backslash is at `at`, and moves `at` past it.
char escaped_byte(std::string_view text, std::size_t& at) {
  const char name = at < text.size() ? text[at++] : ' ';
  if (name == 'r') return '\r';
  if (name == 'n') return '\n';
  if (name == '0') return '\0';
  if (name == '\\') return '\\';
  if (name != 'x' || at + 2 > text.size()) throw std::invalid_argument("no such escape");
  const int value = hex_digit(text[at]) * 16 + hex_digit(text[at + 1]);
  at += 2;
  return static_cast<char>(value);
}

std::string unescape(std::string_view text) {
  std::string bytes;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at++];
    const bool is_plain = c >= ' ' && c <= '~';
    if (!is_plain) throw std::invalid_argument("a byte that is not printable ASCII");
    bytes.push_back(c == '\\' ? escaped_byte(text, at) : c);
  }
  return bytes;
}

Tick duration(std::string_view text) {
  Tick value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (error != std::errc{} || value < 0) throw std::invalid_argument("no duration");
  if (unit == "ms") return value;
  if (unit == "s") return value * kTickHz;
  throw std::invalid_argument("a duration is in ms or s");
}

void read_option(Transcript& transcript, std::string_view text) {
  const std::size_t blank = text.find(' ');
  if (blank == text.npos) throw std::invalid_argument("an option is a name and a value");
  const std::string_view name = text.substr(0, blank);
  const std::string value(text.substr(blank + 1));
  if (name == "robot") {
    transcript.robot = value;
  } else if (name == "workcell") {
    transcript.workcell = value;
  } else if (name == "compat" && (value == "paper" || value == "mark3")) {
    transcript.profile = value == "paper" ? Profile::kPaper : Profile::kMark3;
  } else {
    throw std::invalid_argument("no such option or value");
  }
}

TranscriptStep read_step(char sign, std::string_view text) {
  TranscriptStep step;
  if (sign == '>') {
    step.kind = StepKind::kSend;
    step.bytes = unescape(text);
  } else if (sign == '<') {
    step.kind = StepKind::kExpect;
    step.bytes = unescape(text);
  } else if (sign == '~') {
    step.kind = StepKind::kPass;
    step.ticks = duration(text);
  } else if (sign == '!' && (text == "closed" || text == "hang up")) {
    step.kind = text == "closed" ? StepKind::kClosed : StepKind::kHangUp;
  } else {
    throw std::invalid_argument("a line begins with > < ~ ! @ or #");
  }
  return step;
}

void read_line(Transcript& transcript, std::string_view line, int number) {
  if (line.empty() || line[0] == '#') return;
  if (line.back() == ' ' || line.back() == '\t')
    throw std::invalid_argument("a blank at the end: write \\x20");
  int wire = 1;
  const bool has_wire = line[0] >= '1' && line[0] <= '9';
  if (has_wire) {
    wire = line[0] - '0';
    line.remove_prefix(1);
  }
  if (line.size() > 1 && line[1] != ' ') throw std::invalid_argument("a blank follows the sign");
  const char sign = line.empty() ? ' ' : line[0];
  const std::string_view rest = line.size() > 2 ? line.substr(2) : std::string_view{};
  if (sign == '@') {
    if (!transcript.steps.empty()) throw std::invalid_argument("options come first");
    return read_option(transcript, rest);
  }
  TranscriptStep step = read_step(sign, rest);
  step.line_number = number;
  step.wire = wire;
  transcript.steps.push_back(std::move(step));
}

// --- Playing.

std::string in_quotes(std::string_view bytes) {
  return bytes.empty() ? "nothing" : "'" + readable(bytes) + "'";
}

class Player {
 public:
  explicit Player(const Transcript& transcript)
      : transcript_(transcript),
        simulation_(std::make_shared<const Model>(robot_named(transcript.robot),
                                                  workcell_named(transcript.workcell),
                                                  transcript.profile)) {}

  std::vector<std::string> play() {
    for (const TranscriptStep& step : transcript_.steps) take(step);
    const int end = transcript_.steps.empty() ? 0 : transcript_.steps.back().line_number;
    for (auto& [number, wire] : wires_) expect(end, number, "");
    return std::move(failures_);
  }

 private:
  void take(const TranscriptStep& step) {
    switch (step.kind) {
      case StepKind::kSend: return wire(step.wire).send(step.bytes, simulation_);
      case StepKind::kExpect: return expect(step.line_number, step.wire, step.bytes);
      case StepKind::kPass: return simulation_.advance_to(simulation_.tick() + step.ticks);
      case StepKind::kClosed:
        if (!wire(step.wire).is_closed())
          fail(step.line_number, "expected the line closed, got it open");
        return;
      case StepKind::kHangUp: expect(step.line_number, step.wire, ""); wires_.erase(step.wire);
    }
  }

  Wire& wire(int number) {
    return wires_.try_emplace(number, simulation_.model_ptr()).first->second;
  }

  void expect(int line_number, int number, std::string_view bytes) {
    const std::string received = wire(number).received();
    if (received == bytes) return;
    fail(line_number, "line " + std::to_string(number) + ": expected " + in_quotes(bytes) +
                          ", got " + in_quotes(received));
  }

  void fail(int line_number, const std::string& what) {
    failures_.push_back(transcript_.file + ":" + std::to_string(line_number) + ": " + what);
  }

  const Transcript& transcript_;
  Simulation simulation_;
  std::map<int, Wire> wires_;
  std::vector<std::string> failures_;
};

}  // namespace

Transcript parse_transcript(std::string_view text, const std::string& file) {
  Transcript transcript;
  transcript.file = file;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    try {
      read_line(transcript, text.substr(0, end), number);
    } catch (const std::invalid_argument& why) {
      refuse(file, number, why.what());
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return transcript;
}

std::vector<std::string> play(const Transcript& transcript) { return Player(transcript).play(); }

}  // namespace xr3::test
