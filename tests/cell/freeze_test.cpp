// A frozen cell: time stands, whoever asks, until it may pass again as before.
#include <gtest/gtest.h>

#include "cell/cell.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

constexpr WallNs kSecond = 1'000'000'000;

/// The code of a refusal; empty if the call was executed.
std::string apply(Cell& cell, const call::Call& call, WallNs now) {
  const Applied applied = cell.apply(Input{call}, now);
  const auto* no = std::get_if<call::Refused>(&applied.outcome);
  return no == nullptr ? "" : no->code;
}

TEST(Freeze, TimeStandsUntilUnfreeze) {
  Cell cell("main", test::rhino(), SimClock::real({}, 0));
  cell.catch_up(kSecond);
  EXPECT_EQ(apply(cell, call::Freeze{}, kSecond), "");
  EXPECT_TRUE(cell.snapshot().is_frozen);
  cell.catch_up(31 * kSecond);
  EXPECT_EQ(cell.state().tick, kTickHz);
  EXPECT_EQ(apply(cell, call::Unfreeze{}, 31 * kSecond), "");
  cell.catch_up(32 * kSecond);
  EXPECT_EQ(cell.state().tick, 2 * kTickHz);
  EXPECT_FALSE(cell.snapshot().is_frozen);
}

TEST(Freeze, NoCallLetsTimePass) {
  Cell cell("main", test::rhino(), SimClock::real({}, 0));
  apply(cell, call::Freeze{}, 0);
  EXPECT_EQ(apply(cell, call::Freeze{}, 0), "");
  EXPECT_EQ(apply(cell, call::Pause{}, 0), "");
  EXPECT_EQ(apply(cell, call::Resume{}, 0), "frozen");
  EXPECT_EQ(apply(cell, call::Step{5}, 0), "frozen");
  EXPECT_EQ(apply(cell, call::RunUntil{5, 5}, 0), "frozen");
  EXPECT_EQ(apply(cell, call::Reset{}, 0), "");
  EXPECT_TRUE(cell.is_frozen()) << "a robot that starts over is still frozen";
  apply(cell, call::Unfreeze{}, 0);
  cell.catch_up(kSecond);
  EXPECT_EQ(cell.state().tick, kTickHz) << "the clock was real before";
}

TEST(Freeze, APausedClockStaysPaused) {
  Cell cell("main", test::rhino(), SimClock::real({}, 0));
  apply(cell, call::Pause{}, 0);
  apply(cell, call::Freeze{}, 0);
  apply(cell, call::Unfreeze{}, 0);
  cell.catch_up(kSecond);
  EXPECT_EQ(cell.state().tick, 0);
  EXPECT_EQ(apply(cell, call::Unfreeze{}, 0), "") << "no effect";
}

TEST(Freeze, TheByteClockStandsToo) {
  Cell cell("main", test::rhino(), SimClock::bytes());
  cell.set_byte_clock({});
  cell.apply(LineOpened{"test"}, 0);
  apply(cell, call::Freeze{}, 0);
  cell.apply(BytesIn{1, "E+5\rE?E?"}, 0);
  EXPECT_EQ(cell.state().tick, 0);
  EXPECT_EQ(cell.find_line(1)->outbox(), "%%") << "the counter has not changed";
  apply(cell, call::Unfreeze{}, 0);
  cell.apply(BytesIn{1, "E?"}, 0);
  EXPECT_GT(cell.state().tick, 0);
}

TEST(Freeze, ARobotInItsPastWaitsThereAfterwards) {
  Cell cell("main", test::rhino(), SimClock::real({}, 0));
  const auto past =
      std::make_shared<const MachineSnapshot>(MachineSnapshot{cell.model_ptr(), cell.state()});
  cell.catch_up(kSecond);
  apply(cell, call::Freeze{}, kSecond);
  cell.apply(Rewind{past, {}}, kSecond);
  apply(cell, call::Unfreeze{}, kSecond);
  cell.catch_up(2 * kSecond);
  EXPECT_EQ(cell.state().tick, 0);
  EXPECT_EQ(apply(cell, call::Resume{}, 2 * kSecond), "");
  cell.catch_up(3 * kSecond);
  EXPECT_EQ(cell.state().tick, kTickHz);
}

TEST(Freeze, TheArmOfAControllerCannotBeFrozen) {
  Cell cell("main", test::rhino(), SimClock::real({}, 0));
  cell.connect_device("/dev/ttyS0", {});
  EXPECT_EQ(apply(cell, call::Freeze{}, 0), "has_device");
}

TEST(Notice, IsAnEvent) {
  Cell cell("main", test::rhino(), SimClock::manual());
  EXPECT_EQ(apply(cell, call::SayNotice{"Save your work"}, 0), "");
  std::vector<CellEvent> events;
  cell.copy_events(1, 10, events);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(std::get<NoticeNote>(events[0].note).text, "Save your work");
}

}  // namespace
}  // namespace xr3
