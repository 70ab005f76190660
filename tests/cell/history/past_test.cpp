#include "cell/history/past.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "tests/support/models.hpp"
#include "tests/support/random_inputs.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kPastBudget = std::size_t{64} << 20U;

ModelPtr past_model() {
  static const auto model = std::make_shared<const Model>(
      test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"), Profile::kPaper);
  return model;
}

Past past_at(const Cell& cell, const History& history, const ReplayTime& time) {
  return make_past(recording_header(cell, ""), *history.part_before(time), time);
}

/// The states that a cell has had after its inputs and advances. Of several at one tick, the last
/// counts.
class States : public CellObserver {
 public:
  explicit States(Cell& cell) : cell_(cell) { cell.observe(*this); }
  ~States() override { cell_.end_observation(*this); }

  std::map<ReplayTime, State> all;

 private:
  void before(const Cell& cell, const Input&) override { note(cell); }
  void after(const Cell& cell, const Input&, const Applied&) override { note(cell); }

  void note(const Cell& cell) { all[{cell.epoch(), cell.state().tick}] = cell.state(); }

  Cell& cell_;
};

/// Whether an epoch ended at this time, so that the call that ended it does not belong to it.
bool ends_epoch(const std::map<ReplayTime, State>& all, const ReplayTime& time) {
  const auto next = all.upper_bound(time);
  return next != all.end() && next->first.epoch != time.epoch;
}

RC_GTEST_PROP(Past, EachMomentIsMadeAgain, ()) {
  monitor::ByteBudget budget(kPastBudget);
  const bool is_real = *rc::gen::arbitrary<bool>();
  Cell cell("main", past_model(), is_real ? SimClock::real({}, 0) : SimClock::manual());
  if (*rc::gen::arbitrary<bool>()) cell.set_line_speed({parse_serial_settings("9600-7e2"), {}});
  const History history(cell, 3'600'000, budget);
  const States states(cell);
  test::RandomInputs(cell, *rc::gen::arbitrary<std::uint32_t>()).play(*rc::gen::inRange(1, 150));
  for (const auto& [time, state] : states.all) {
    if (!history.covers(time) || ends_epoch(states.all, time)) continue;
    const Past past = past_at(cell, history, time);
    RC_ASSERT((past.difference ? to_text(*past.difference) : "") == std::string());
    RC_ASSERT(past.cell->epoch() == time.epoch);
    RC_ASSERT(past.cell->state() == state);
  }
}

TEST(Past, AMomentBetweenInputs) {
  monitor::ByteBudget budget(kPastBudget);
  Cell cell("main", past_model(), SimClock::real({}, 0));
  const History history(cell, 3'600'000, budget);
  cell.apply(LineOpened{"test"}, 0);
  cell.apply(BytesIn{1, "E+100\r"}, 5'000'000);
  cell.catch_up(700'000'000);
  const State then = cell.state();
  cell.catch_up(60'000'000'000);
  const Past past = past_at(cell, history, {0, 700});
  EXPECT_FALSE(past.difference);
  EXPECT_EQ(past.cell->state(), then);
  EXPECT_EQ(past.cell->name(), "main");
  EXPECT_EQ(past_at(cell, history, {0, 60'000}).cell->state(), cell.state());
}

TEST(Past, ALongStepIsStoppedInItsMiddle) {
  monitor::ByteBudget budget(kPastBudget);
  Cell cell("main", past_model(), SimClock::manual());
  const History history(cell, 3'600'000, budget);
  cell.apply(LineOpened{"test"}, 0);
  cell.apply(BytesIn{1, "E+100\r"}, 0);
  cell.apply(Input{call::Call{call::Step{100'000}}}, 0);
  const Past past = past_at(cell, history, {0, 123});
  EXPECT_EQ(past.cell->state().tick, 123);
  EXPECT_GT(past.cell->state().motor(past_model()->index_of('E')).error, 0);
}

TEST(Past, TheByteClockStopsWithinARead) {
  monitor::ByteBudget budget(kPastBudget);
  Cell cell("main", past_model(), SimClock::bytes());
  cell.set_byte_clock({});
  const History history(cell, 3'600'000, budget);
  cell.apply(LineOpened{"test"}, 0);
  cell.apply(BytesIn{1, "E+90\r"}, 0);
  cell.apply(BytesIn{1, std::string(400, 'I')}, 0);
  ASSERT_GT(cell.state().tick, 2000);
  const Past past = past_at(cell, history, {0, 1000});
  EXPECT_FALSE(past.difference);
  EXPECT_GE(past.cell->state().tick, 1000);
  EXPECT_LE(past.cell->state().tick, 1030);
  EXPECT_NE(past.cell->state(), cell.state());
}

TEST(Past, AHistoryBeginsWhileTheByteClockIsPaused) {
  monitor::ByteBudget budget(kPastBudget);
  Cell cell("main", past_model(), SimClock::bytes());
  cell.set_byte_clock({});
  cell.apply(Input{call::Call{call::Pause{}}}, 0);
  const History history(cell, 3'600'000, budget);
  cell.apply(Input{call::Call{call::Resume{}}}, 0);
  cell.apply(LineOpened{"test"}, 0);
  cell.apply(BytesIn{1, "E+90\r" + std::string(400, 'I')}, 0);
  ASSERT_GT(cell.state().tick, 2000);
  const Past past = past_at(cell, history, {0, cell.state().tick});
  EXPECT_FALSE(past.difference);
  EXPECT_EQ(past.cell->state(), cell.state());
}

}  // namespace
}  // namespace xr3
