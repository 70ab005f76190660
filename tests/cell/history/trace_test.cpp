#include "cell/history/trace.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

#include "cell/history/past.hpp"
#include "tests/support/models.hpp"
#include "tests/support/random_inputs.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kTraceBudget = std::size_t{64} << 20U;
constexpr Tick kHour = 3'600'000;

ModelPtr traced_model() {
  static const auto model = std::make_shared<const Model>(
      test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"), Profile::kPaper);
  return model;
}

PastTrace trace_of(const Cell& cell, const History& history, const TraceSpan& span) {
  return trace_past(recording_header(cell, ""), *history.part_before({span.epoch, span.from}),
                    span);
}

/// The joints and the tool of a cell, as a trace has them.
Json shown(const Cell& cell) {
  return state_json(cell.model(), cell.snapshot(), Fields{{"joints", "tool"}});
}

Json without_tick(Json state) {
  state.erase("tick");
  return state;
}

std::vector<Tick> ticks_of(const PastTrace& trace) {
  std::vector<Tick> ticks;
  for (const Json& each : trace.states) ticks.push_back(each["tick"].get<Tick>());
  return ticks;
}

/// The times of the inputs of a cell.
class InputTimes : public CellObserver {
 public:
  explicit InputTimes(Cell& cell) : cell_(cell) { cell.observe(*this); }
  ~InputTimes() override { cell_.end_observation(*this); }

  std::set<ReplayTime> times;

 private:
  void before(const Cell& cell, const Input&) override { note(cell); }
  void after(const Cell& cell, const Input&, const Applied&) override { note(cell); }
  void note(const Cell& cell) { times.insert({cell.epoch(), cell.state().tick}); }

  Cell& cell_;
};

RC_GTEST_PROP(PastTrace, HasTheStatesThatALookShows, ()) {
  monitor::ByteBudget budget(kTraceBudget);
  const bool is_real = *rc::gen::arbitrary<bool>();
  Cell cell("main", traced_model(), is_real ? SimClock::real({}, 0) : SimClock::manual());
  const History history(cell, kHour, budget);
  const InputTimes inputs(cell);
  test::RandomInputs(cell, *rc::gen::arbitrary<std::uint32_t>()).play(*rc::gen::inRange(1, 150));
  for (const EpochSpan& epoch : history.epochs()) {
    const Tick from = *rc::gen::inRange(epoch.from, epoch.to + 1);
    const Tick end = history.end_of_part({epoch.epoch, from});
    RC_ASSERT(from <= end);
    RC_ASSERT(end <= epoch.to);
    const PastTrace trace = trace_of(cell, history, {epoch.epoch, from, end, 250});
    RC_ASSERT(!trace.difference);
    for (const Json& each : trace.states) {
      const ReplayTime time{epoch.epoch, each["tick"].get<Tick>()};
      if (inputs.times.contains(time)) continue;  // the look shows what came of them
      const Past past =
          make_past(recording_header(cell, ""), *history.part_before({epoch.epoch, from}), time);
      RC_ASSERT(shown(*past.cell) == without_tick(each));
    }
  }
}

TEST(PastTrace, LeavesOutTheStatesOfARestButTheFirstAndTheLast) {
  monitor::ByteBudget budget(kTraceBudget);
  Cell cell("main", traced_model(), SimClock::real({}, 0));
  const History history(cell, kHour, budget);
  cell.apply(LineOpened{"test"}, 0);
  cell.apply(BytesIn{1, "E+10\r"}, 5'000'000'000);
  cell.catch_up(60'000'000'000);
  const PastTrace trace = trace_of(cell, history, {0, 0, 60'000, 100});
  EXPECT_FALSE(trace.difference);
  const std::vector<Tick> ticks = ticks_of(trace);
  EXPECT_EQ(std::vector<Tick>(ticks.begin(), ticks.begin() + 3), (std::vector<Tick>{0, 5000, 5100}))
      << "at rest until the move";
  EXPECT_EQ(ticks.back(), 60'000);
  EXPECT_LT(ticks.size(), 20U) << "at rest after it";
  EXPECT_EQ(without_tick(trace.states.back()), shown(cell));
}

TEST(PastTrace, EndsWithItsPart) {
  monitor::ByteBudget budget(kTraceBudget);
  Cell cell("main", traced_model(), SimClock::manual());
  const History history(cell, kHour, budget);
  cell.apply(LineOpened{"test"}, 0);
  for (int i = 0; i < 30; ++i) {
    cell.apply(BytesIn{1, i % 2 == 0 ? "E+100\r" : "E-100\r"}, 0);
    cell.apply(Input{call::Call{call::Step{1000}}}, 0);
  }
  ASSERT_GT(history.parts(), 2U);
  const Tick end = history.end_of_part({0, 5});
  EXPECT_LT(end, 30'000);
  EXPECT_GT(history.end_of_part({0, end}), end) << "the next part begins there";
  EXPECT_EQ(history.end_of_part({0, 30'000}), 30'000);
  const PastTrace trace = trace_of(cell, history, {0, 5, end, 100});
  EXPECT_EQ(ticks_of(trace).front(), 100);
  EXPECT_EQ(ticks_of(trace).back(), end);
}

TEST(PastTrace, TheByteClockGivesAStateAfterItsInputs) {
  monitor::ByteBudget budget(kTraceBudget);
  Cell cell("main", traced_model(), SimClock::bytes());
  cell.set_byte_clock({});
  const History history(cell, kHour, budget);
  cell.apply(LineOpened{"test"}, 0);
  cell.apply(BytesIn{1, "E+90\r"}, 0);
  for (int i = 0; i < 100; ++i) cell.apply(BytesIn{1, "I"}, 0);
  const PastTrace trace = trace_of(cell, history, {0, 0, cell.state().tick, 50});
  EXPECT_FALSE(trace.difference);
  EXPECT_GT(trace.states.size(), 8U);
  EXPECT_TRUE(std::ranges::is_sorted(ticks_of(trace)));
}

TEST(PastTrace, AnEpochBeginsWithinItsPart) {
  monitor::ByteBudget budget(kTraceBudget);
  Cell cell("main", traced_model(), SimClock::manual());
  const History history(cell, kHour, budget);
  cell.apply(LineOpened{"test"}, 0);
  cell.apply(Input{call::Call{call::Step{5000}}}, 0);
  cell.apply(Input{call::Call{call::Reset{}}}, 0);
  cell.apply(Input{call::Call{call::Step{300}}}, 0);
  const PastTrace trace = trace_of(cell, history, {1, 0, 300, 100});
  EXPECT_EQ(ticks_of(trace), (std::vector<Tick>{0, 300}));
}

TEST(PastTrace, AnEpochEndsIt) {
  monitor::ByteBudget budget(kTraceBudget);
  Cell cell("main", traced_model(), SimClock::manual());
  const History history(cell, kHour, budget);
  cell.apply(LineOpened{"test"}, 0);
  cell.apply(BytesIn{1, "E+90\r"}, 0);
  cell.apply(Input{call::Call{call::Step{500}}}, 0);
  cell.apply(Input{call::Call{call::Reset{}}}, 0);
  const PastTrace trace = trace_of(cell, history, {0, 0, 500, 100});
  EXPECT_EQ(ticks_of(trace).size(), 6U);
}

}  // namespace
}  // namespace xr3
