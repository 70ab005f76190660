// Time: the state is bit-identical for every division into steps, and time at rest costs nothing.
#include "core/step.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <tuple>

#include "core/motor.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::rhino;
using test::Rig;
using test::roomy_rhino;

// An action and the ticks until the next one: plain numbers, which a failing property can print and
// shrink. Most actions are moves.
using Happening = std::tuple<int, char, int, int>;

rc::Gen<Happening> happening() {
  return rc::gen::tuple(rc::gen::inRange(0, 20), rc::gen::inRange('A', 'H'),
                        rc::gen::inRange(-128, 128), rc::gen::inRange(0, 1000));
}

Command command_of(const Happening& happening) {
  const auto& [what, label, counts, ticks] = happening;
  switch (what) {
    case 19: return Stop{label};
    case 18: return SoftHome{};
    case 17: return ControllerReset{};
    case 16: return ToggleSimulator{};
    case 15:
    case 14:
    case 13: return SetSpeed{label, 1 + (counts + 128) % 255};
    default: return Move{label, counts};
  }
}

Tick ticks_after(const Happening& happening) { return std::get<3>(happening); }

std::vector<Happening> arbitrary_day() {
  return *rc::gen::container<std::vector<Happening>>(happening());
}

// Home, or a few counts from the region, from a limit, or from a coupled joint's limit.
State arbitrary_start(const Model& model) {
  switch (*rc::gen::inRange(0, 4)) {
    case 0: return test::state_at(model, {{'E', -320}, {'F', 765}, {'A', -12}});
    case 1: return test::state_at(model, {{'D', 600}, {'C', -495}});
    case 2: return test::state_at(model, {{'E', 400}, {'D', 515}, {'B', -20}});
    default: return initial_state(model);
  }
}

void tick_by_tick(const Model& model, State& state, Tick ticks, Events& events) {
  for (Tick i = 0; i < ticks; ++i) step(model, state, events);
}

void in_slices(const Model& model, State& state, Tick ticks, std::mt19937& random, Events& events) {
  const Tick end = state.tick + ticks;
  while (state.tick < end) {
    const Tick to = std::min(end, state.tick + static_cast<Tick>(random() % 400));
    if (random() % 2 == 0) run_to_rest(model, state, to, events);
    advance_to(model, state, to, events);
  }
}

RC_GTEST_PROP(Step, RandomTimeSlicesEqualSingleTicks, (std::uint32_t seed)) {
  const ModelPtr model = *rc::gen::element(rhino(), roomy_rhino(), rhino(Profile::kMark3));
  std::mt19937 random(seed);
  State single = arbitrary_start(*model);
  Events single_events;
  State sliced = single;
  Events sliced_events;
  CameraCache camera;
  for (const Happening& happening : arbitrary_day()) {
    const Command command = command_of(happening);
    const Reply reply = execute(*model, single, command, single_events, camera);
    RC_ASSERT(execute(*model, sliced, command, sliced_events, camera) == reply);
    tick_by_tick(*model, single, ticks_after(happening), single_events);
    in_slices(*model, sliced, ticks_after(happening), random, sliced_events);
    RC_ASSERT(single == sliced);
  }
  RC_ASSERT(single_events == sliced_events);
}

Rig rig_at_an_arbitrary_start() {
  Rig rig(*rc::gen::element(rhino(), roomy_rhino()));
  rig.simulation.restore(arbitrary_start(rig.model()));
  return rig;
}

RC_GTEST_PROP(Step, JointsStayWithinTheirLimits, ()) {
  Rig rig = rig_at_an_arbitrary_start();
  for (const Happening& happening : arbitrary_day()) {
    rig.execute(command_of(happening));
    rig.pass(ticks_after(happening));
    const Positions at = positions(rig.model(), rig.state().motors);
    for (int m = 0; m < rig.model().motor_count(); ++m) {
      const Counts position = at[static_cast<std::size_t>(m)];
      RC_ASSERT(position >= rig.model().motor(m).low);
      RC_ASSERT(position <= rig.model().motor(m).high);
    }
  }
}

// `blocked` and the phase of a blocked motor follow from counts and error counters, independent of
// the history.
RC_GTEST_PROP(Step, AMotorIsMarkedBlockedExactlyIfItsNextCountIs, ()) {
  Rig rig = rig_at_an_arbitrary_start();
  for (const Happening& happening : arbitrary_day()) {
    rig.execute(command_of(happening));
    rig.pass(ticks_after(happening));
    const State& state = rig.state();
    const Positions at = positions(rig.model(), state.motors);
    for (int m = 0; m < rig.model().motor_count(); ++m) {
      const MotorState& motor = state.motor(m);
      const bool is_blocked =
          motor.error != 0 && obstacle(rig.model(), state, at, m) != Blocked::kNo;
      RC_ASSERT((motor.blocked != Blocked::kNo) == is_blocked);
      if (motor.error == 0 || is_blocked) RC_ASSERT(motor.phase == 0);
    }
  }
}

TEST(Step, InAStallOnlyTheTickChanges) {
  Rig rig;
  rig.travel('E', -440);
  ASSERT_EQ(rig.state().stall, Stall::kProtectedRegion);
  rig.move('F', 100);
  State state = rig.state();
  Events events;
  tick_by_tick(rig.model(), state, 1000, events);
  State wanted = rig.state();
  wanted.tick += 1000;
  EXPECT_EQ(state, wanted);
  EXPECT_TRUE(events.empty());
}

// --- Rest.

template <class Work>
std::chrono::milliseconds duration_of(Work work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() -
                                                               start);
}

// Large enough that only a loop over the ticks exceeds it.
constexpr std::chrono::milliseconds kAtOnce{50};
constexpr Tick kForEver = 1'000'000'000'000;

TEST(Step, ACellAtRestAdvancesATrillionTicksAtOnce) {
  Rig rig;
  rig.move('E', 5);
  EXPECT_LT(duration_of([&] { rig.pass(kForEver); }), kAtOnce);
  EXPECT_EQ(rig.simulation.tick(), kForEver);
  EXPECT_EQ(rig.count('E'), 5);
}

TEST(Step, ABlockedCellAdvancesATrillionTicksAtOnce) {
  Rig rig(roomy_rhino());
  rig.stand_at({{'F', 771}});
  rig.move('F', 5);
  EXPECT_LT(duration_of([&] { rig.pass(kForEver); }), kAtOnce);
  EXPECT_EQ(rig.error('F'), 5);
}

TEST(Step, AStalledCellAdvancesATrillionTicksAtOnce) {
  Rig rig;
  rig.travel('E', -440);
  ASSERT_EQ(rig.state().stall, Stall::kProtectedRegion);
  rig.move('F', 100);
  const Tick before = rig.simulation.tick();
  EXPECT_LT(duration_of([&] { rig.pass(kForEver); }), kAtOnce);
  EXPECT_EQ(rig.simulation.tick(), before + kForEver);
  EXPECT_EQ(rig.error('F'), 100);
}

TEST(Step, TheSlowestMoveTakes128Seconds) {
  Rig rig(roomy_rhino());
  rig.execute(SetSpeed{'B', 1});
  rig.move('B', -128);
  rig.simulation.advance_to(127'999);
  EXPECT_FALSE(rig.simulation.is_at_rest());
  rig.pass(1);
  EXPECT_TRUE(rig.simulation.is_at_rest());
  EXPECT_EQ(rig.count('B'), -128);
}

// A motor that waits until another makes room follows it by one count.
TEST(Step, TheSlowestMoveAfterAnotherTakesOneMoreCount) {
  Rig rig(roomy_rhino());
  rig.stand_at({{'D', 600}, {'C', -501}});
  for (const char label : {'D', 'C'}) {
    rig.execute(SetSpeed{label, 1});
    rig.move(label, -128);
  }
  rig.simulation.run_to_rest(1'000'000);
  EXPECT_EQ(rig.simulation.tick(), 129'000);
  EXPECT_EQ(rig.count('C'), -629);
}

RC_GTEST_PROP(Step, WithoutInputACellComesToRest, ()) {
  Rig rig = rig_at_an_arbitrary_start();
  for (const Happening& happening : arbitrary_day()) {
    rig.execute(command_of(happening));
    rig.pass(ticks_after(happening));
  }
  const Tick one_trailing = 1000;
  rig.simulation.run_to_rest(rig.simulation.tick() + 128'000 + one_trailing);
  RC_ASSERT(rig.simulation.is_at_rest());
}

TEST(Step, RunToRestStopsWithTheLastMotor) {
  Rig rig(roomy_rhino());
  rig.move('E', 11);
  rig.move('F', 55);
  rig.simulation.run_to_rest(10'000);
  EXPECT_EQ(rig.simulation.tick(), 500) << "55 counts at 110 a second";
  rig.move('E', 11);
  rig.simulation.run_to_rest(550);
  EXPECT_EQ(rig.simulation.tick(), 550) << "not past the limit";
}

TEST(Step, AdvancingToAPastTickChangesNothing) {
  Rig rig;
  rig.move('E', 5);
  rig.pass(20);
  const State before = rig.state();
  rig.simulation.advance_to(7);
  EXPECT_EQ(rig.state(), before);
}

}  // namespace
}  // namespace xr3
