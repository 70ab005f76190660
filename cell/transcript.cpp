#include "cell/transcript.hpp"

#include <cassert>
#include <nlohmann/json.hpp>

#include "cell/digest.hpp"
#include "protocol/monitor/call.hpp"
#include "protocol/monitor/saved_cell.hpp"

namespace xr3 {
namespace {

// The records of a line are hashed in pieces of about this size.
constexpr std::size_t kPieceBytes = 512;
constexpr std::uint64_t kSevenBits = 0x7F;
constexpr std::uint64_t kMoreFollows = 0x80;
constexpr std::string_view kPrefix = "sha256:";

int nibble_of(char digit) { return digit <= '9' ? digit - '0' : digit - 'a' + 10; }
char digit_of(unsigned nibble) { return "0123456789abcdef"[nibble]; }

}  // namespace

std::string_view name_of(TranscriptMark mark) {
  constexpr std::array<std::string_view, kTranscriptMarks> kNames{"arrival_order",
                                                                  "not_bytes_alone", "silence"};
  return kNames.at(static_cast<std::size_t>(mark));
}

std::string transcript_digest(const TranscriptSummary& summary, const Model& model,
                              const State& state, Micros remainder) {
  const SavedCell end{robot_hash(model), model.workcell(), state};
  return sha256(summary.lines_digest + ' ' + std::to_string(summary.lines) + ' ' +
                std::to_string(remainder) + ' ' + saved_cell_to_json(end).dump());
}

// --- One line.

/// Seven bits a byte, the lowest first.
void Transcript::OneLine::put(std::uint64_t number) {
  while (number > kSevenBits) {
    rest_.push_back(static_cast<char>((number & kSevenBits) | kMoreFollows));
    number >>= 7U;
  }
  rest_.push_back(static_cast<char>(number));
}

// A byte in is the ticks since the last record, doubled, and the byte; a reply is those and one,
// its length and its bytes.
void Transcript::OneLine::add(Tick tick, bool is_out, std::string_view bytes) {
  assert(tick >= last_);
  const auto passed = static_cast<std::uint64_t>(tick - last_);
  last_ = tick;
  put(passed * 2 + (is_out ? 1 : 0));
  if (is_out) put(bytes.size());
  rest_ += bytes;
  if (rest_.size() >= kPieceBytes) fold();
}

void Transcript::OneLine::fold() {
  chain_ = sha256(chain_ + rest_);
  rest_.clear();
  if (rest_.capacity() > 2 * kPieceBytes) rest_.shrink_to_fit();  // after an image
}

std::string Transcript::OneLine::digest() const {
  return sha256(std::to_string(number_) + ' ' + chain_ + rest_);
}

// --- All lines.

Transcript::OneLine& Transcript::find(LineId line) {
  const auto found = open_.find(line);
  return found != open_.end() ? found->second : open_.emplace(line, ++lines_).first->second;
}

void Transcript::add_in(LineId line, Tick tick, std::uint8_t byte) {
  ++bytes_in_;
  const char as_char = static_cast<char>(byte);
  find(line).add(tick, false, {&as_char, 1});
}

void Transcript::add_out(LineId line, Tick tick, std::string_view reply) {
  if (reply.empty()) return;
  bytes_out_ += reply.size();
  find(line).add(tick, true, reply);
}

void Transcript::end_line(LineId line) {
  const auto found = open_.find(line);
  if (found == open_.end()) return;
  add(found->second.digest(), closed_);
  open_.erase(found);
}

void Transcript::add(const std::string& digest, Sum& sum) {
  const std::string_view digits = std::string_view(digest).substr(kPrefix.size());
  assert(digits.size() == sum.size());
  for (std::size_t i = 0; i < sum.size(); ++i)
    sum[i] = static_cast<std::uint8_t>(sum[i] ^ nibble_of(digits[i]));
}

TranscriptSummary Transcript::summary() const {
  TranscriptSummary all{"", lines_, bytes_in_, bytes_out_, {}};
  Sum sum = closed_;
  for (const auto& [id, line] : open_) add(line.digest(), sum);
  for (const std::uint8_t nibble : sum) all.lines_digest.push_back(digit_of(nibble));
  for (std::size_t i = 0; i < kTranscriptMarks; ++i) {
    if (marks_[i]) all.marks.push_back(static_cast<TranscriptMark>(i));
  }
  return all;
}

}  // namespace xr3
