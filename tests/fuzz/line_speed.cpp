// Fuzzes two lines of a cell whose bytes take time. Properties: state and replies do not depend on
// the steps in which time advances; what waits is bounded; when the clients have ended their input
// and read their replies, nothing is under way.
//
// Input: the first byte selects the speed (bits 0 and 1) and the profile (bit 2); then chunks as in
// common/chunks.hpp.
#include <algorithm>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "tests/fuzz/common/chunks.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/support/models.hpp"

namespace xr3::fuzz::line_speed_fuzzer {
namespace {

constexpr Tick kMaxPacedTicks = 100'000;
constexpr Tick kMaxQuickPacedTicks = 1000;
constexpr int kMaxRests = 1000;
constexpr std::size_t kMaxPicture = 192 * 192 / 6;

LineSpeed speed_for(unsigned choice) {
  constexpr Rate kHundred{100'000'000};
  switch (choice) {
    case 0: return {parse_serial_settings("9600-7e2"), Rate{}};
    case 1: return {parse_serial_settings("300-8n1"), kHundred};
    case 2: return {parse_serial_settings("4294967295-8n1"), kHundred};
    default: return {std::nullopt, kHundred};
  }
}

class PacedLines {
 public:
  PacedLines(ModelPtr model, const LineSpeed& speed)
      : cell_("fuzz", std::move(model), SimClock::manual()) {
    cell_.set_line_speed(speed);
    for (LineId line = 1; line <= 2; ++line) cell_.apply(LineOpened{"fuzz"}, 0);
  }

  void send(LineId line, std::string_view bytes) {
    cell_.apply(BytesIn{line, bytes}, 0);
    check_bounds();
  }
  void pass(Tick ticks) {
    cell_.apply(Input{call::Call{call::Step{ticks}}}, 0);
    check_bounds();
  }
  void take() {
    for (LineId line = 1; line <= 2; ++line) {
      const std::string bytes(cell_.find_line(line)->outbox());
      replies_ += bytes;
      cell_.sent({line, bytes.size()});
    }
  }
  /// The clients end their input and read their replies until nothing is under way.
  void finish() {
    for (LineId line = 1; line <= 2; ++line) cell_.apply(InputEnded{line}, 0);
    for (int i = 0; i < kMaxRests && !(cell_.is_at_rest() && is_drained()); ++i) {
      cell_.apply(Input{call::Call{call::RunUntil{std::nullopt, kMaxPacedTicks}}}, 0);
      take();
    }
    require(is_drained(), "everything arrives in the end");
  }

  const State& state() const { return cell_.state(); }
  const std::string& replies() const { return replies_; }

 private:
  bool is_drained() const {
    return std::ranges::all_of(cell_.lines(),
                               [](const auto& line) { return line.second.is_drained(); });
  }
  void check_bounds() const {
    for (const auto& [id, line] : cell_.lines()) {
      require(line.input_under_way() <= LinePace::kMaxInput + kMostHeld, "waiting bytes");
      require(line.outbox().size() < 3 * SerialLine::kFullOutbox + kMaxPicture, "the outbox");
      require(line.bytes_acted() <= line.bytes_in(), "bytes that act have arrived");
    }
  }
  static constexpr std::size_t kMostHeld = 64;  ///< by the detector, released together

  Cell cell_;
  std::string replies_;
};

void run(std::string_view input, Effort effort) {
  static const ModelPtr models[] = {test::rhino(Profile::kPaper), test::rhino(Profile::kMark3)};
  if (input.empty()) return;
  const auto choice = static_cast<unsigned char>(input[0]);
  const LineSpeed speed = speed_for(choice & 3U);
  const ModelPtr& model = models[choice >> 2U & 1U];
  PacedLines undivided(model, speed);
  PacedLines sliced(model, speed);
  const Tick most = effort == Effort::kFull ? kMaxPacedTicks : kMaxQuickPacedTicks;
  for (const Chunk& chunk : chunks_of(input.substr(1), most)) {
    for (PacedLines* lines : {&undivided, &sliced}) {
      if (chunk.wire != 0) lines->send(static_cast<LineId>(chunk.wire), chunk.bytes);
    }
    if (chunk.wire != 0 || chunk.ticks == 0) continue;
    undivided.pass(chunk.ticks);
    const Tick slice = chunk.ticks / 16 + 1;
    for (Tick left = chunk.ticks; left > 0; left -= slice) sliced.pass(std::min(left, slice));
    undivided.take();
    sliced.take();
    require(undivided.state() == sliced.state(), "state of sliced time");
    require(undivided.replies() == sliced.replies(), "replies in sliced time");
  }
  undivided.finish();
}

const Registration kRegistration{{"line_speed", 256, run}};

}  // namespace
}  // namespace xr3::fuzz::line_speed_fuzzer
