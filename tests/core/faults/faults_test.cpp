// Faults of the machine: when they begin and end, what they do to motors, encoders, switches and
// the grip, and that the division of time into steps makes no difference.
#include "core/faults/faults.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <functional>
#include <random>

#include "core/faults/effects.hpp"
#include "core/faults/motor_faults.hpp"
#include "core/kinematics.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::Rig;
using test::roomy_rhino;

using Change = std::function<void(Fault&)>;

Fault fault_of(FaultKind kind, const Change& change, char joint = 'E') {
  Fault fault;
  fault.name = "it";
  fault.kind = kind;
  fault.joint = traits_of(kind).target == FaultTarget::kJoint ? joint : char{0};
  change(fault);
  return fault;
}

Rig rig_with(std::vector<Fault> faults, ModelPtr model = roomy_rhino()) {
  Rig rig(std::move(model));
  rig.simulation.install_faults({7, std::move(faults)});
  return rig;
}

std::vector<FaultPhase> phases_of(const Rig& rig) {
  std::vector<FaultPhase> phases;
  for (const FaultNews& each : rig.events_of<FaultNews>()) phases.push_back(each.phase);
  return phases;
}

constexpr auto kBegan = FaultPhase::kBegan;
constexpr auto kEnded = FaultPhase::kEnded;
constexpr auto kEffect = FaultPhase::kEffect;

// --- Motors.

TEST(Faults, AStuckMotorStandsAndThenGoesOn) {
  Rig rig = rig_with({fault_of(FaultKind::kMotorStuck, [](Fault& f) {
    f.at_tick = 10;
    f.ticks = 5000;
  })});
  rig.move('E', 5);
  rig.simulation.advance_to(5009);
  EXPECT_EQ(rig.count('E'), 0);
  EXPECT_EQ(rig.error('E'), 5);
  EXPECT_FALSE(rig.simulation.is_at_rest()) << "it will go on";
  rig.simulation.run_to_rest(100'000);
  EXPECT_EQ(rig.count('E'), 5);
  EXPECT_EQ(rig.simulation.tick(), 46 + 5000) << "46 ticks of running at 110 counts a second";
  EXPECT_EQ(phases_of(rig), (std::vector{kBegan, kEnded}));
  EXPECT_EQ(test::ticks_of<FaultNews>(rig.simulation.events()), (std::vector<Tick>{10, 5010}));
}

TEST(Faults, AMotorThatIsStuckForGoodIsAtRest) {
  Rig rig = rig_with({fault_of(FaultKind::kMotorStuck, [](Fault& f) { f.from_tick = 0; })});
  rig.move('E', 5);
  EXPECT_TRUE(rig.simulation.is_at_rest());
  rig.pass(1'000'000'000'000);
  EXPECT_EQ(rig.error('E'), 5);
  rig.simulation.clear_faults("it");
  EXPECT_FALSE(rig.simulation.is_at_rest());
  rig.settle();
  EXPECT_EQ(rig.count('E'), 5);
}

TEST(Faults, ASlowMotorRunsInAPartOfTheTicks) {
  for (const std::uint32_t percent : {1U, 33U, 50U, 99U}) {
    Rig rig = rig_with({fault_of(FaultKind::kMotorSlow, [percent](Fault& f) {
      f.from_tick = 0;
      f.percent = percent;
    })});
    rig.move('E', 11);  // 100 ticks at 110 counts a second
    rig.simulation.run_to_rest(1'000'000);
    EXPECT_EQ(rig.count('E'), 11);
    EXPECT_EQ(rig.simulation.tick(), (100 * 100 + percent - 1) / percent) << percent;
  }
}

TEST(Faults, ASlowMotorMayOutlastTheUsualBoundOfRest) {
  Rig rig = rig_with({fault_of(FaultKind::kMotorSlow, [](Fault& f) {
    f.from_tick = 0;
    f.percent = 1;
  })});
  rig.execute(SetSpeed{'E', 1});
  rig.move('E', 2);
  rig.settle();
  EXPECT_FALSE(rig.simulation.is_at_rest());
  rig.simulation.run_to_rest(1'000'000);
  EXPECT_EQ(rig.simulation.tick(), 200'000);
}

TEST(Faults, RunningTicksAreSpreadEvenly) {
  for (int percent = 1; percent <= 100; ++percent) {
    const auto each = static_cast<std::uint8_t>(percent);
    Tick running = 0;
    for (Tick tick = 1; tick <= 500; ++tick) {
      running += running_ticks(each, tick - 1, tick);
      ASSERT_EQ(running, tick * percent / 100);
    }
    for (Tick from = 0; from < 120; ++from) {
      for (Tick wanted = 1; wanted < 20; ++wanted) {
        const Tick found = tick_after_running(each, from, wanted);
        ASSERT_EQ(running_ticks(each, from, found), wanted);
        ASSERT_EQ(running_ticks(each, from, found - 1), wanted - 1);
      }
    }
  }
}

// --- Encoders.

TEST(Faults, ASlippingEncoderLosesCountsThatTheMotorMakes) {
  Rig rig = rig_with({fault_of(FaultKind::kEncoderSlip, [](Fault& f) {
    f.from_tick = 0;
    f.count = 3;
  })});
  rig.move('E', 10);
  rig.settle();
  EXPECT_EQ(rig.error('E'), 0);
  EXPECT_EQ(rig.count('E'), 13) << "the program believes 10";
  EXPECT_EQ(rig.events_of<FaultNews>().size(), 3U);
  EXPECT_EQ(rig.events_of<FaultNews>()[1],
            (FaultNews{"it", FaultKind::kEncoderSlip, kEffect, 2, 'E', 2}));
}

TEST(Faults, AnEncoderThatAlwaysSlipsLosesEverySecondCount) {
  Rig rig = rig_with({fault_of(FaultKind::kEncoderSlip, [](Fault& f) { f.from_tick = 0; })});
  rig.move('E', -50);
  rig.settle();
  EXPECT_TRUE(rig.simulation.is_at_rest());
  EXPECT_EQ(rig.count('E'), -100);
}

TEST(Faults, ChanceDependsOnTheCountAndNotOnTheTime) {
  const auto slipped_at = [](Tick wait) {
    Rig rig =
        rig_with({fault_of(FaultKind::kEncoderSlip, [](Fault& f) { f.chance = 100'000'000; })});
    rig.pass(wait);
    rig.travel('E', 300);
    std::vector<std::int64_t> counts;
    for (const FaultNews& each : rig.events_of<FaultNews>()) counts.push_back(each.at);
    return counts;
  };
  EXPECT_EQ(slipped_at(0), slipped_at(12'345));
  EXPECT_GT(slipped_at(0).size(), 15U);
  EXPECT_LT(slipped_at(0).size(), 60U);
}

TEST(Faults, AnAtTickFaultOfCountsActsOnce) {
  Rig rig = rig_with({fault_of(FaultKind::kEncoderSlip, [](Fault& f) { f.at_tick = 30; })});
  rig.move('E', 10);
  rig.settle();
  EXPECT_EQ(rig.count('E'), 11);
  EXPECT_EQ(rig.events_of<FaultNews>().front().at, 3) << "the fourth count, at tick 37";
}

// --- Switches.

TEST(Faults, ASwitchStuckOpenDoesNotClose) {
  Rig rig = rig_with({fault_of(FaultKind::kSwitchStuckOpen, [](Fault& f) {
    f.at_tick = 2000;
    f.ticks = 1000;
  })});
  rig.travel('E', -50);
  EXPECT_TRUE(rig.motor('E').switch_closed);
  rig.simulation.advance_to(2000);
  EXPECT_FALSE(rig.motor('E').switch_closed);
  EXPECT_EQ(rig.execute(QuerySwitch{'E'}), Reply(SwitchState{false}));
  rig.simulation.advance_to(3000);
  EXPECT_TRUE(rig.motor('E').switch_closed);
  EXPECT_EQ(rig.events_of<SwitchChanged>().size(), 3U);
}

TEST(Faults, ASwitchStuckClosedIsClosedAtHome) {
  Rig rig = rig_with({fault_of(FaultKind::kSwitchStuckClosed, [](Fault& f) { f.at_tick = 0; })});
  EXPECT_TRUE(rig.motor('E').switch_closed);
  EXPECT_EQ(std::get<SwitchBits>(rig.execute(QuerySwitchesI{})).closed, 4);
  rig.execute(SoftHome{});
  EXPECT_TRUE(rig.motor('E').switch_closed);
}

TEST(Faults, ABouncingSwitchReadsBothWaysAfterAChange) {
  Rig rig = rig_with({fault_of(FaultKind::kSwitchBouncing, [](Fault& f) {
    f.from_tick = 0;
    f.bounce_ms = 50;
  })});
  rig.execute(SetSpeed{'E', 1});
  rig.stand_at({{'E', -39}});
  rig.simulation.install_faults({7, {fault_of(FaultKind::kSwitchBouncing, [](Fault& f) {
                                   f.from_tick = 0;
                                   f.bounce_ms = 50;
                                 })}});
  rig.move('E', -1);
  rig.settle();
  ASSERT_TRUE(rig.motor('E').switch_closed);
  int opens = 0;
  for (int i = 0; i < 50; ++i) {
    opens += rig.execute(QuerySwitch{'E'}) == Reply(SwitchState{false}) ? 1 : 0;
    rig.pass(1);
  }
  EXPECT_GT(opens, 10);
  EXPECT_LT(opens, 40);
  for (int i = 0; i < 50; ++i, rig.pass(1))
    EXPECT_EQ(rig.execute(QuerySwitch{'E'}), Reply(SwitchState{true}));
  EXPECT_EQ(rig.events_of<FaultNews>().size(), 2U) << "it began, and had one effect";
}

// --- The controller.

TEST(Faults, APowerCycleSetsTheCountersTo0) {
  Rig rig = rig_with({fault_of(FaultKind::kPowerCycle, [](Fault& f) { f.at_tick = 100; })});
  rig.execute(SetSpeed{'E', 10});
  rig.execute(SetOutput{3, true});
  rig.move('E', 50);
  rig.simulation.advance_to(99);
  EXPECT_EQ(rig.error('E'), 50);
  rig.simulation.advance_to(10'000);
  EXPECT_EQ(rig.error('E'), 0);
  EXPECT_EQ(rig.count('E'), 0);
  EXPECT_EQ(rig.motor('E').speed, 110);
  EXPECT_EQ(rig.state().io.outputs, 0);
  EXPECT_EQ(rig.state().faults.power_cycles, 1U);
  EXPECT_EQ(test::ticks_of<FaultNews>(rig.simulation.events()), (std::vector<Tick>{100}));
}

TEST(Faults, APowerCycleComesAtRestAndInAStall) {
  Rig rig = rig_with({fault_of(FaultKind::kPowerCycle, [](Fault& f) { f.at_tick = 60'000; })},
                     test::rhino());
  rig.travel('E', -440);
  ASSERT_EQ(rig.state().stall, Stall::kProtectedRegion);
  ASSERT_NE(rig.error('E'), 0);
  rig.simulation.run_to_rest(100'000);
  EXPECT_LT(rig.simulation.tick(), 60'000) << "at rest, although a fault is to come";
  rig.simulation.advance_to(100'000);
  EXPECT_EQ(rig.error('E'), 0);
}

// --- The grip.

Rig rig_holding_a_block(std::vector<Fault> faults) {
  Rig rig(std::make_shared<const Model>(test::robot_named("rhino-xr3"),
                                        test::workcell_named("rhino-xr3"), Profile::kPaper));
  rig.stand_at({{'E', 449}, {'D', -625}, {'A', -16}});
  rig.simulation.install_faults({7, std::move(faults)});
  rig.move('A', 60);
  rig.settle();
  return rig;
}

TEST(Faults, ABlockSlipsOutOfTheJawsWhenItIsLifted) {
  Rig rig = rig_holding_a_block({fault_of(FaultKind::kGripSlip, [](Fault& f) { f.at_tick = 0; })});
  ASSERT_TRUE(rig.state().held);
  ASSERT_NE(rig.error('A'), 0);
  rig.travel('E', -100);
  EXPECT_FALSE(rig.state().held);
  const Block& red = rig.state().blocks[0];
  EXPECT_EQ(red.centroid_um.z, red.size_um.z / 2) << "it fell onto the table";
  EXPECT_EQ(rig.error('A'), 0) << "the jaws have closed";
  EXPECT_EQ(rig.events_of<Released>().size(), 1U);
  EXPECT_EQ(rig.events_of<FaultNews>().size(), 1U);
}

TEST(Faults, ABlockThatStandsDoesNotSlip) {
  Rig rig = rig_holding_a_block({fault_of(FaultKind::kGripSlip, [](Fault& f) { f.at_tick = 0; })});
  rig.travel('F', 20);
  EXPECT_TRUE(rig.state().held);
}

// --- Setting and clearing.

TEST(Faults, ATickInThePastMeansNow) {
  Rig rig(roomy_rhino());
  rig.pass(1000);
  rig.simulation.set_fault(fault_of(FaultKind::kMotorStuck, [](Fault& f) {
    f.at_tick = 0;
    f.ticks = 50;
  }));
  EXPECT_EQ(rig.state().faults.all[0].fault.at_tick, 1000);
  EXPECT_EQ(phases_of(rig), (std::vector{FaultPhase::kSet, kBegan}));
  rig.pass(50);
  EXPECT_EQ(phases_of(rig), (std::vector{FaultPhase::kSet, kBegan, kEnded}));
}

TEST(Faults, AFaultWithTheSameNameReplacesTheOther) {
  Rig rig = rig_with({fault_of(FaultKind::kMotorStuck, [](Fault& f) { f.at_tick = 0; })});
  rig.simulation.set_fault(fault_of(
      FaultKind::kMotorStuck, [](Fault& f) { f.at_tick = 0; }, 'D'));
  ASSERT_EQ(rig.state().faults.all.size(), 1U);
  rig.move('E', 5);
  rig.move('D', 5);
  rig.settle();
  EXPECT_EQ(rig.error('E'), 0);
  EXPECT_EQ(rig.error('D'), 5);
}

TEST(Faults, ClearedFaultsLeaveNothing) {
  Rig rig = rig_with({fault_of(FaultKind::kSwitchStuckClosed, [](Fault& f) { f.at_tick = 0; }),
                      fault_of(FaultKind::kMotorSlow, [](Fault& f) {
                        f.name = "slow";
                        f.at_tick = 500;
                        f.percent = 7;
                      })});
  EXPECT_FALSE(rig.simulation.clear_faults("other"));
  EXPECT_TRUE(rig.simulation.clear_faults(""));
  Faults wanted;
  wanted.seed = 7;
  EXPECT_EQ(rig.state().faults, wanted);
  EXPECT_FALSE(rig.motor('E').switch_closed);
}

TEST(Faults, EventsOfOneFaultAreLimitedInASecond) {
  Rig rig = rig_with({fault_of(FaultKind::kByteDropped, [](Fault& f) { f.from_tick = 0; })});
  for (std::uint64_t i = 0; i < 100; ++i) rig.simulation.carry_input({1, LineSide::kIn, i}, 'E');
  EXPECT_EQ(rig.events_of<FaultNews>().size(), kMaxFaultNews);
  EXPECT_EQ(rig.state().faults.all[0].effects, 100U);
  rig.simulation.advance_to(1000);
  rig.simulation.carry_input({1, LineSide::kIn, 100}, 'E');
  EXPECT_EQ(rig.events_of<FaultNews>().back().effects, 101U);
}

// --- Time.

/// A kind and five numbers, from which a fault is made.
using Numbers = std::tuple<int, int, int, int, int, int>;

Fault fault_from(const Numbers& numbers, std::size_t index) {
  constexpr FaultKind kKinds[] = {FaultKind::kMotorStuck,        FaultKind::kMotorSlow,
                                  FaultKind::kEncoderSlip,       FaultKind::kSwitchStuckOpen,
                                  FaultKind::kSwitchStuckClosed, FaultKind::kSwitchBouncing,
                                  FaultKind::kPowerCycle,        FaultKind::kGripSlip};
  const auto [kind, joint, begin, ticks, percent, count] = numbers;
  Fault fault;
  fault.name = "fault-" + std::to_string(index);
  fault.kind = kKinds[kind];
  const FaultTraits& traits = traits_of(fault.kind);
  if (traits.target == FaultTarget::kJoint) fault.joint = static_cast<char>('A' + joint);
  if (fault.kind == FaultKind::kMotorSlow) fault.percent = static_cast<std::uint32_t>(percent);
  if (fault.kind == FaultKind::kPowerCycle || percent % 3 == 0) {
    fault.at_tick = begin;
  } else {
    fault.from_tick = begin;
  }
  if (traits.manner == FaultManner::kOnce) return fault;
  if (ticks % 3 != 0) fault.ticks = ticks;
  if (traits.manner == FaultManner::kEffects && !fault.ticks)
    fault.count = static_cast<std::uint32_t>(count);
  if (traits.has_probability && !fault.at_tick && percent % 2 == 0)
    fault.chance = static_cast<std::uint32_t>(percent) * (kCertain / 100);
  return fault;
}

constexpr std::size_t kSeveral = 12;

FaultPlan arbitrary_plan() {
  const auto numbers = *rc::gen::container<std::vector<Numbers>>(
      rc::gen::tuple(rc::gen::inRange(0, 8), rc::gen::inRange(0, 6), rc::gen::inRange(0, 3000),
                     rc::gen::inRange(1, 4000), rc::gen::inRange(1, 100), rc::gen::inRange(1, 9)));
  FaultPlan plan{*rc::gen::arbitrary<std::uint64_t>(), {}};
  for (const Numbers& each : numbers) {
    if (plan.faults.size() < kSeveral) plan.faults.push_back(fault_from(each, plan.faults.size()));
  }
  return plan;
}

using Order = std::tuple<char, int, int>;

void advance_in_slices(Rig& rig, Tick ticks, std::mt19937& random) {
  const Tick end = rig.simulation.tick() + ticks;
  while (rig.simulation.tick() < end) {
    const Tick to = std::min(end, rig.simulation.tick() + static_cast<Tick>(random() % 700));
    if (random() % 2 == 0) rig.simulation.run_to_rest(to);
    rig.simulation.advance_to(to);
  }
}

RC_GTEST_PROP(Faults, RandomTimeSlicesEqualSingleTicks, (std::uint32_t seed)) {
  const FaultPlan plan = arbitrary_plan();
  std::mt19937 random(seed);
  Rig sliced = rig_with({});
  sliced.simulation.install_faults(plan);
  State single = sliced.state();
  Events events = sliced.simulation.events();
  CameraCache camera;
  auto orders = *rc::gen::container<std::vector<Order>>(rc::gen::tuple(
      rc::gen::inRange('A', 'G'), rc::gen::inRange(-128, 128), rc::gen::inRange(0, 400)));
  orders.resize(std::min(orders.size(), 2 * kSeveral));
  for (const auto& [label, counts, ticks] : orders) {
    sliced.move(label, counts);
    execute(sliced.model(), single, Move{label, counts}, events, camera);
    advance_in_slices(sliced, ticks, random);
    for (Tick i = 0; i < ticks; ++i) step(sliced.model(), single, events);
    RC_ASSERT(single == sliced.state());
  }
  RC_ASSERT(events == sliced.simulation.events());
}

// The first tick at which is_at_rest() holds is the one where run_to_rest() stops.
RC_GTEST_PROP(Faults, RunToRestStopsWhereSingleTicksFindRest, ()) {
  Rig rig = rig_with({});
  rig.simulation.install_faults(arbitrary_plan());
  for (char label = 'A'; label < 'G'; ++label) rig.move(label, *rc::gen::inRange(-128, 128));
  State single = rig.state();
  rig.simulation.run_to_rest(6000);
  Events events;
  while (single.tick < 6000 && !is_at_rest(rig.model(), single)) step(rig.model(), single, events);
  RC_ASSERT(single == rig.state());
}

RC_GTEST_PROP(Faults, ACopyOfTheStateGoesOnAlike, ()) {
  Rig rig = rig_with({});
  rig.simulation.install_faults(arbitrary_plan());
  for (char label = 'A'; label < 'G'; ++label) rig.move(label, *rc::gen::inRange(-128, 128));
  rig.pass(*rc::gen::inRange(0, 3000));
  State copy = rig.state();
  refresh_faults(rig.model(), copy);
  RC_ASSERT(copy == rig.state());
  Simulation other(rig.simulation.model_ptr());
  other.restore(copy);
  rig.simulation.take_events();
  rig.pass(4000);
  other.advance_to(other.tick() + 4000);
  RC_ASSERT(other.state() == rig.state());
  RC_ASSERT(other.events() == rig.simulation.events());
}

}  // namespace
}  // namespace xr3
