// The 8-bit error counter and the integer phase, tick by tick.
#include "core/motor.hpp"

#include <gtest/gtest.h>

#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::Rig;
using test::roomy_rhino;

Tick ticks_for(int counts, int speed) { return (1000 * counts + speed - 1) / speed; }

TEST(Motor, TheFirstCountComesAtPhase1000) {
  for (int speed = 1; speed <= 255; ++speed) {
    Rig rig(roomy_rhino());
    rig.pass(17);
    rig.execute(SetSpeed{'B', speed});
    rig.move('B', 3);
    rig.pass(ticks_for(1, speed) - 1);
    EXPECT_EQ(rig.count('B'), 0) << speed;
    rig.pass(1);
    EXPECT_EQ(rig.count('B'), 1) << speed;
  }
}

TEST(Motor, EveryCountComesAtItsOwnTickWithoutDrift) {
  for (const int speed : {1, 7, 60, 110, 160, 254, 255}) {
    Rig rig(roomy_rhino());
    rig.execute(SetSpeed{'B', speed});
    rig.move('B', -100);
    for (int n = 1; n <= 100; ++n) {
      rig.simulation.advance_to(ticks_for(n, speed) - 1);
      ASSERT_EQ(rig.count('B'), 1 - n) << speed;
      rig.pass(1);
      ASSERT_EQ(rig.count('B'), -n) << speed;
    }
  }
}

TEST(Motor, AverageSpeedOver100SecondsIsExact) {
  for (const int speed : {3, 110, 159, 255}) {
    Rig rig(roomy_rhino());
    rig.execute(SetSpeed{'B', speed});
    rig.move('B', 100);
    while (rig.simulation.tick() < 100'000) {
      rig.pass(50);
      rig.move('B', 100 - rig.error('B'));
    }
    EXPECT_EQ(rig.count('B'), speed * 100) << speed;
  }
}

TEST(Motor, MakesAtMostOneCountPerTick) {
  Rig rig(roomy_rhino());
  rig.execute(SetSpeed{'B', 255});
  rig.move('B', 127);
  for (Counts before = 0; rig.error('B') != 0; before = rig.count('B')) {
    rig.pass(1);
    ASSERT_LE(rig.count('B') - before, 1);
  }
  EXPECT_EQ(rig.simulation.tick(), ticks_for(127, 255));
}

TEST(Motor, ReportsItsArrivalOnce) {
  Rig rig(roomy_rhino());
  rig.move('E', 5);
  rig.pass(10'000);
  EXPECT_EQ(rig.events_of<Reached>(), (std::vector<Reached>{{'E', 5}}));
  EXPECT_EQ(test::ticks_of<Reached>(rig.simulation.events()),
            (std::vector<Tick>{ticks_for(5, 110)}));
}

struct AddCase {
  int before;
  int add;
  int after;
  bool wraps;
};

constexpr AddCase kAdditions[] = {
    {0, 5, 5, false},      {5, -5, 0, false},      {100, 27, 127, false},    {100, 28, -128, true},
    {100, 100, -56, true}, {127, 127, -2, true},   {-100, -28, -128, false}, {-100, -29, 127, true},
    {-128, -128, 0, true}, {-128, -1, 127, true},  {-128, 127, -1, false},   {127, -128, -1, false},
    {1, 127, -128, true},  {0, -128, -128, false}, {-56, 100, 44, false},
};

TEST(Motor, TheErrorCounterIsASignedByte) {
  for (const auto& [before, add, after, wraps] : kAdditions) {
    MotorState motor;
    motor.error = static_cast<std::int8_t>(before);
    EXPECT_EQ(add_to_error(motor, add), wraps) << before << " and " << add;
    EXPECT_EQ(motor.error, after) << before << " and " << add;
  }
}

TEST(Motor, AWrappedCounterReversesTheMotor) {
  Rig rig(roomy_rhino());
  rig.move('E', 100);
  rig.move('E', 100);
  EXPECT_EQ(rig.error('E'), -56);
  rig.settle();
  EXPECT_EQ(rig.count('E'), -56);
}

// --- The phase. B at 100 counts per second has half a count of phase after five ticks.

Rig half_a_count_on_the_way(int counts) {
  Rig rig(roomy_rhino());
  rig.execute(SetSpeed{'B', 100});
  rig.move('B', counts);
  rig.pass(5);
  return rig;
}

struct PhaseCase {
  const char* what;
  int running;  ///< counts to go when the phase was half a count
  Command then;
  int phase;
};

TEST(Motor, CommandsKeepOrClearThePhase) {
  const PhaseCase cases[] = {
      {"more the same way keeps it", 5, Move{'B', 3}, 500},
      {"less the same way keeps it", 5, Move{'B', -4}, 500},
      {"nothing at all keeps it", 5, Move{'B', 0}, 500},
      {"a change of speed keeps it", 5, SetSpeed{'B', 250}, 500},
      {"another joint keeps it", 5, Stop{'C'}, 500},
      {"a question keeps it", 5, QueryError{'B'}, 500},
      {"coming to 0 loses it", 5, Move{'B', -5}, 0},
      {"a change of sign loses it", 5, Move{'B', -9}, 0},
      {"a change of sign the other way loses it", -5, Move{'B', 9}, 0},
      {"wrapping loses it", 100, Move{'B', 100}, 0},
      {"wrapping downwards loses it", -100, Move{'B', -100}, 0},
      {"a stop loses it", 5, Stop{'B'}, 0},
      {"a reset loses it", 5, ControllerReset{}, 0},
      {"the soft home loses it", 5, SoftHome{}, 0},
  };
  for (const PhaseCase& wanted : cases) {
    Rig rig = half_a_count_on_the_way(wanted.running);
    ASSERT_EQ(rig.motor('B').phase, 500);
    rig.execute(wanted.then);
    EXPECT_EQ(rig.motor('B').phase, wanted.phase) << wanted.what;
  }
}

TEST(Motor, AChangeOfSpeedAppliesToTheRestOfTheCount) {
  Rig rig = half_a_count_on_the_way(5);
  rig.execute(SetSpeed{'B', 250});
  rig.pass(1);
  EXPECT_EQ(rig.count('B'), 0);
  rig.pass(1);
  EXPECT_EQ(rig.count('B'), 1);
}

TEST(Motor, ThePhaseIs0AfterTheLastCount) {
  Rig rig(roomy_rhino());
  rig.execute(SetSpeed{'B', 255});
  rig.move('B', 1);
  rig.pass(4);
  EXPECT_EQ(rig.count('B'), 1);
  EXPECT_EQ(rig.motor('B').phase, 0) << "20 were over";
}

TEST(Motor, TicksToCountIsTheTickOfTheNextCount) {
  for (const int speed : {1, 3, 110, 255}) {
    for (const int phase : {0, 1, 499, 745, 999}) {
      MotorState motor;
      motor.speed = static_cast<std::uint8_t>(speed);
      motor.phase = static_cast<std::int16_t>(phase);
      const Tick ticks = ticks_to_count(motor);
      EXPECT_GE(phase + ticks * speed, 1000);
      EXPECT_LT(phase + (ticks - 1) * speed, 1000);
    }
  }
}

}  // namespace
}  // namespace xr3
