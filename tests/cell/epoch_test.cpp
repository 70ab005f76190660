#include <gtest/gtest.h>

#include "cell/cell.hpp"
#include "tests/support/models.hpp"
#include "tests/support/on_event.hpp"

namespace xr3 {
namespace {

constexpr WallNs kRewindMs = 1'000'000;

/// A cell whose joint E has moved for a second since the state that is kept.
struct Moved {
  explicit Moved(SimClock clock = SimClock::real({}, 0)) : cell("main", test::rhino(), clock) {
    cell.apply(LineOpened{"test"}, 0);
    then = std::make_shared<const MachineSnapshot>(MachineSnapshot{cell.model_ptr(), cell.state()});
    cell.apply(BytesIn{1, "E+100\rC"}, 0);
    cell.catch_up(1000 * kRewindMs);
    cell.take_woken_lines();
    events.clear();
  }
  Counts count() const { return cell.state().motor(cell.model().index_of('E')).count; }
  std::string refusal(call::Call call) {
    const Applied applied = cell.apply(Input{std::move(call)}, 2000 * kRewindMs);
    const auto* refused = std::get_if<call::Refused>(&applied.outcome);
    return refused == nullptr ? "" : refused->code;
  }

  std::vector<CellEvent> events;
  MachineSnapshotPtr then;
  Cell cell;
  test::OnEvent on_event{cell, [this](const CellEvent& each) { events.push_back(each); }};
};

TEST(Rewind, TakesTheCellBackAndLetsItWait) {
  Moved moved;
  Cell& cell = moved.cell;
  EXPECT_GT(moved.count(), 0);
  cell.apply(Rewind{moved.then, {}}, 1000 * kRewindMs);
  EXPECT_TRUE(cell.is_in_past());
  EXPECT_EQ(cell.epoch(), 1);
  EXPECT_EQ(cell.clock().mode(), ClockMode::kManual);
  EXPECT_EQ(cell.state(), moved.then->state);
  cell.catch_up(2000 * kRewindMs);
  EXPECT_EQ(cell.state().tick, 0);
  EXPECT_EQ(cell.apply(BytesIn{1, "?"}, 2000 * kRewindMs).bytes_taken, 0U);
  ASSERT_EQ(moved.events.size(), 2U);
  const auto& note = std::get<EpochNote>(moved.events[1].note);
  EXPECT_EQ(note.call, "seek");
}

TEST(Rewind, CallsThatChangeTheCellAreRefused) {
  Moved moved;
  moved.cell.apply(Rewind{moved.then, {}}, 1000 * kRewindMs);
  EXPECT_EQ(moved.refusal(call::Step{5}), "in_the_past");
  EXPECT_EQ(moved.refusal(call::Reset{}), "in_the_past");
  EXPECT_EQ(moved.refusal(call::Pause{}), "in_the_past");
  EXPECT_EQ(moved.refusal(call::LoadSnapshot{"a", nullptr}), "in_the_past");
  EXPECT_EQ(moved.refusal(call::SaveSnapshot{"a"}), "");
  EXPECT_EQ(moved.refusal(call::Resume{}), "");
  EXPECT_FALSE(moved.cell.is_in_past());
  EXPECT_EQ(moved.refusal(call::Reset{}), "");
}

TEST(Rewind, ResumeReadsTheLinesAgainWithEmptyParsers) {
  Moved moved;
  Cell& cell = moved.cell;
  cell.apply(Rewind{moved.then, {}}, 1000 * kRewindMs);
  EXPECT_TRUE(is_unread(cell.value(), 1));
  cell.apply(Input{call::Call{call::Resume{}}}, 1000 * kRewindMs);
  EXPECT_FALSE(is_unread(cell.value(), 1));
  EXPECT_EQ(cell.take_woken_lines(), std::vector<LineId>{1});
  cell.apply(BytesIn{1, "E?"}, 1000 * kRewindMs);
  EXPECT_EQ(cell.find_line(1)->outbox(), " ") << "the C before is forgotten";
  cell.catch_up(1500 * kRewindMs);
  EXPECT_EQ(cell.state().tick, 500);
}

TEST(Rewind, AManualClockStaysManual) {
  Moved moved(SimClock::manual());
  for (int times = 0; times < 2; ++times) moved.cell.apply(Rewind{moved.then, {}}, 0);
  EXPECT_EQ(moved.refusal(call::Resume{}), "");
  EXPECT_FALSE(moved.cell.is_in_past());
  EXPECT_EQ(moved.cell.clock().mode(), ClockMode::kManual);
  EXPECT_EQ(moved.refusal(call::Resume{}), "");
  EXPECT_EQ(moved.cell.clock().mode(), ClockMode::kReal) << "only this one is about the clock";
}

TEST(Rewind, TheByteClockGoesOnFromTheWholeTick) {
  Cell cell("main", test::rhino(), SimClock::bytes());
  cell.set_byte_clock({});
  const auto then =
      std::make_shared<const MachineSnapshot>(MachineSnapshot{cell.model_ptr(), cell.state()});
  cell.apply(LineOpened{"test"}, 0);
  cell.apply(BytesIn{1, "E+9\rE?"}, 0);
  ASSERT_GT(cell.state().tick, 0);
  cell.apply(Rewind{then, {}}, 0);
  EXPECT_EQ(cell.clock_remainder(), 0);
  cell.apply(LineSilent{1}, 0);
  EXPECT_EQ(cell.state().tick, 0);
  cell.apply(Input{call::Call{call::Resume{}}}, 0);
  EXPECT_EQ(cell.clock().mode(), ClockMode::kBytes);
  EXPECT_EQ(cell.apply(BytesIn{1, "E?"}, 0).bytes_taken, 2U);
  EXPECT_GT(cell.state().tick, 0);
}

}  // namespace
}  // namespace xr3
