#include "cell/recording/continued.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cell/recording/recorder.hpp"
#include "cell/recording/replayer.hpp"
#include "cell/recording/state_hash.hpp"
#include "protocol/json/source.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

/// The header of a recording that goes on from the end of the cell, through its JSON.
recording::Header end_of(const Cell& cell) {
  recording::Header header = recording_header(cell, "xr3 test");
  header.start = continued_state(cell, "sha256:of-the-files");
  const std::string text = recording::header_to_json(header).dump();
  const JsonSource source(text, "end");
  data::Reading reading(source, data::Unit::kMm);
  auto read = recording::read_header(reading);
  EXPECT_EQ(to_text(reading.take_findings()), "");
  return *std::move(read);
}

void say(Cell& cell, std::string_view bytes) {
  const LineId line = cell.apply(LineOpened{"a", LineKind::kTcp, Guard::kOff}, 0).line;
  cell.apply(BytesIn{line, bytes}, 0);
  cell.apply(LineClosed{line, LineCloseReason::kClientClosed}, 0);
}

void make(Cell& cell, call::Call call) { cell.apply(Input{std::move(call)}, 0); }

/// Both do the same from now on.
void expect_equal(Cell& one, Cell& other) {
  EXPECT_EQ(StateHasher().hash(one), StateHasher().hash(other));
  EXPECT_EQ(one.clock().running_mode(), other.clock().running_mode());
  EXPECT_EQ(one.value().initial_faults, other.value().initial_faults);
  for (Cell* each : {&one, &other}) {
    say(*each, "E-7\rE?F+3\r");
    make(*each, call::Step{700});
    make(*each, call::LoadSnapshot{"mine", nullptr});
    make(*each, call::Step{70});
    make(*each, call::Reset{});
    say(*each, "C+5\r");
  }
  EXPECT_EQ(StateHasher().hash(one), StateHasher().hash(other));
}

TEST(Continued, AFreshCellGoesOnWithEverything) {
  Cell cell("ada", test::rhino(), SimClock::manual());
  say(cell, "E+40\rC-5\r");
  make(cell, call::Step{150});
  make(cell, call::SaveSnapshot{"mine"});
  make(cell, call::Reset{});
  say(cell, "D+40\r");
  make(cell, call::Step{100});
  ASSERT_EQ(cell.epoch(), 1);
  Cell next("ada", test::rhino(), SimClock::manual());
  begin_at_start(next, end_of(cell), 0);
  EXPECT_TRUE(next.is_continued());
  EXPECT_EQ(next.epoch(), 1);
  EXPECT_EQ(next.state().tick, 100);
  expect_equal(cell, next);
}

TEST(Continued, APausedClockStaysPausedWithItsRate) {
  Cell cell("ada", test::rhino(), SimClock::real(Rate{5'000'000}, 0));
  make(cell, call::Pause{});
  Cell next("ada", test::rhino(), SimClock::real(Rate{}, 0));
  begin_at_start(next, end_of(cell), 1'000'000'000);
  EXPECT_EQ(next.clock().mode(), ClockMode::kManual);
  EXPECT_EQ(next.clock().rate(), Rate{5'000'000});
  EXPECT_EQ(next.clock().running_mode(), ClockMode::kReal);
}

TEST(Continued, TheByteClockGoesOnWithItsRemainder) {
  Cell cell("ada", test::rhino(), SimClock::bytes());
  ByteClockSettings settings;
  settings.inquiry_ms = 7;
  cell.set_byte_clock(settings);
  say(cell, "E+40\rE?E?");
  make(cell, call::Pause{});
  Cell next("ada", test::rhino(), SimClock::manual());
  begin_at_start(next, end_of(cell), 0);
  ASSERT_NE(next.byte_clock(), nullptr);
  EXPECT_EQ(next.clock_remainder(), cell.clock_remainder());
  EXPECT_EQ(next.byte_clock()->settings().inquiry_ms, 7);
  EXPECT_EQ(next.clock().mode(), ClockMode::kManual);
  for (Cell* each : {&cell, &next}) {
    make(*each, call::Resume{});
    say(*each, "E?F-3\rE?");
  }
  EXPECT_EQ(StateHasher().hash(cell), StateHasher().hash(next));
}

TEST(Continued, AStartThatTheRobotCannotReachIsRefused) {
  Cell cell("ada", test::rhino(), SimClock::manual());
  recording::Header header = recording_header(cell, "xr3 test");
  header.start = continued_state(cell, "sha256:of-the-files");
  Json json = recording::header_to_json(header);
  json["start"]["state"]["state"]["motors"][1]["count"] = 1'000'000;
  const std::string text = json.dump();
  const JsonSource source(text, "end");
  data::Reading reading(source, data::Unit::kMm);
  EXPECT_FALSE(recording::read_header(reading));
  EXPECT_NE(to_text(reading.take_findings()).find("/start/state/state/motors"), std::string::npos);
}

}  // namespace
}  // namespace xr3
