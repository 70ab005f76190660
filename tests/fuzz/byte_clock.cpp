// Fuzzes two lines of a cell with the byte clock. Properties: replies, state, remainder and
// transcript do not depend on how the bytes are cut; a line that waits is not read, and its turn
// comes; no robot moves while no line is open.
//
// Input: the first byte selects the time of an inquiry (bits 0 and 1) and the profile (bit 2); then
// chunks as in common/chunks.hpp. A chunk of time closes the current line.
#include <string>

#include "cell/cell.hpp"
#include "tests/fuzz/common/chunks.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/support/models.hpp"

namespace xr3::fuzz::byte_clock_fuzzer {
namespace {

constexpr Tick kMaxChunkTicks = 1'000;
constexpr int kMaxTries = 1'000;

std::int64_t inquiry_ms_for(unsigned choice) {
  switch (choice) {
    case 0: return 20;
    case 1: return 0;
    case 2: return 3;
    default: return ByteClockSettings::kMaxInquiryMs;
  }
}

class ByteLines {
 public:
  ByteLines(ModelPtr model, std::int64_t inquiry_ms, std::size_t piece)
      : piece_(piece), cell_("fuzz", std::move(model), SimClock::bytes()) {
    cell_.set_byte_clock({.inquiry_ms = inquiry_ms});
    open();
    open();
  }

  /// Sends on the first or the second of the open lines, in pieces.
  void send(bool is_second, std::string_view bytes) {
    const LineId line = is_second ? newest_ : *current_line(cell_.value());
    if (line_before(cell_.value(), line)) {
      require(cell_.apply(BytesIn{line, bytes}, 0).bytes_taken == 0, "a waiting line is not read");
      return;
    }
    for (int i = 0; i < kMaxTries && !bytes.empty(); ++i) {
      const std::string_view piece = bytes.substr(0, piece_);
      bytes.remove_prefix(cell_.apply(BytesIn{line, piece}, 0).bytes_taken);
      take(line);
    }
  }
  void close_current() {
    const LineId line = *current_line(cell_.value());
    take(line);
    cell_.apply(LineClosed{line}, 0);
    require(cell_.is_at_rest(), "the robot is at rest between two turns");
    require(*current_line(cell_.value()) == newest_, "the next line has its turn");
    open();
  }

  bool operator==(const ByteLines& other) const {
    return cell_.state() == other.cell_.state() && replies_ == other.replies_ &&
           cell_.clock_remainder() == other.cell_.clock_remainder() &&
           cell_.transcript()->summary() == other.cell_.transcript()->summary();
  }

 private:
  void open() { newest_ = cell_.apply(LineOpened{.peer = "fuzz", .guard = Guard::kOff}, 0).line; }
  void take(LineId line) {
    const std::string bytes(cell_.find_line(line)->outbox());
    replies_ += bytes;
    cell_.sent({line, bytes.size()});
  }

  std::size_t piece_;
  Cell cell_;
  LineId newest_ = 0;
  std::string replies_;
};

void run(std::string_view input, Effort) {
  static const ModelPtr models[] = {test::rhino(Profile::kPaper), test::rhino(Profile::kMark3)};
  if (input.empty()) return;
  const auto choice = static_cast<unsigned char>(input[0]);
  const std::int64_t inquiry_ms = inquiry_ms_for(choice & 3U);
  const ModelPtr& model = models[choice >> 2U & 1U];
  ByteLines whole(model, inquiry_ms, input.size());
  ByteLines cut(model, inquiry_ms, 1);
  for (const Chunk& chunk : chunks_of(input.substr(1), kMaxChunkTicks)) {
    for (ByteLines* lines : {&whole, &cut})
      chunk.wire == 0 ? lines->close_current() : lines->send(chunk.wire == 2, chunk.bytes);
    require(whole == cut, "the same in any pieces");
  }
}

const Registration kRegistration{{"byte_clock", 256, run}};

}  // namespace
}  // namespace xr3::fuzz::byte_clock_fuzzer
