#include <gtest/gtest.h>

#include "cell/cell.hpp"
#include "cell/recording/replayer.hpp"
#include "tests/support/models.hpp"
#include "tests/support/recorded.hpp"

namespace xr3 {
namespace {

constexpr WallNs kCheckpointMs = 1'000'000;

/// What happens to a cell at a millisecond: bytes on two lines, calls and faults.
void disturb(Cell& cell, int ms) {
  const WallNs now = ms * kCheckpointMs;
  const LineId line = ms % 2 == 0 ? 1U : 2U;
  if (ms % 7 == 0) cell.apply(BytesIn{line, ms % 14 == 0 ? "E+40\rE?C" : "?D-3\rV"}, now);
  if (ms % 11 == 0) cell.sent({line, cell.find_line(line)->outbox().size()});
  if (ms == 300) cell.apply(Input{call::Call{call::SaveSnapshot{"a"}}}, now);
  if (ms == 700) cell.apply(Input{call::Call{call::LoadSnapshot{"a", nullptr}}}, now);
  if (ms == 500) cell.apply(Input{call::Call{call::SetRate{{3'000'000}}}}, now);
}

TEST(Checkpoint, InputsHaveTheSameEffectAfterIt) {
  test::RecordedCell recorded(
      test::rhino(), {SimClock::real({}, 0), LineSpeed{parse_serial_settings("2400-8n1"), {}}});
  for (int i = 0; i < 2; ++i) recorded.cell.apply(LineOpened{"test"}, 0);
  for (int ms = 1; ms < 400; ++ms) disturb(recorded.cell, ms);
  const Rewindable checkpoint = recorded.cell.checkpoint();
  const std::string middle = StateHasher().hash(recorded.cell);
  const std::size_t before = recorded.entries().size();
  for (int ms = 400; ms < 1000; ++ms) disturb(recorded.cell, ms);

  Cell other("other", test::rhino(), SimClock::real({}, 0));
  other.set_line_speed({parse_serial_settings("2400-8n1"), {}});
  for (int times = 0; times < 2; ++times) {  // the second time from where the first has come to
    other.restore(checkpoint);
    EXPECT_EQ(StateHasher().hash(other), middle);
    Replayer replayer(other, Compared::kAll);
    for (std::size_t i = before; i < recorded.entries().size(); ++i) {
      const auto difference = replayer.apply(recorded.entries()[i]);
      ASSERT_FALSE(difference) << to_text(*difference);
    }
    EXPECT_EQ(StateHasher().hash(other), StateHasher().hash(recorded.cell));
  }
}

TEST(Checkpoint, ItIsAValue) {
  Cell cell("main", test::rhino(), SimClock::manual());
  cell.apply(LineOpened{"test"}, 0);
  cell.apply(BytesIn{1, "E+40\rE"}, 0);
  const Rewindable checkpoint = cell.checkpoint();
  const std::string before = StateHasher().hash(cell);
  cell.apply(BytesIn{1, "?"}, 0);
  cell.apply(LineClosed{1, LineCloseReason::kClientClosed}, 0);
  cell.apply(Input{call::Call{call::Step{500}}}, 0);
  EXPECT_NE(StateHasher().hash(cell), before);
  EXPECT_FALSE(cell.checkpoint() == checkpoint);
  cell.restore(checkpoint);
  EXPECT_TRUE(cell.checkpoint() == checkpoint);
  EXPECT_EQ(StateHasher().hash(cell), before);
  EXPECT_EQ(cell.find_line(1)->outbox(), "");
}

}  // namespace
}  // namespace xr3
