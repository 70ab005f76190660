// The facade: the same files and inputs give the same state, states can be saved and restored, and
// events come in order.
#include "core/simulation.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::Rig;

void play(Simulation& simulation, std::uint32_t seed, int commands) {
  std::mt19937 random(seed);
  for (int i = 0; i < commands; ++i) {
    const char label = static_cast<char>('A' + random() % 6);
    simulation.execute(Move{label, static_cast<int>(random() % 256) - 128});
    simulation.advance_to(simulation.tick() + static_cast<Tick>(random() % 700));
  }
}

TEST(Simulation, TheSameInputGivesTheSameStateAndEvents) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    Simulation one(test::rhino());
    Simulation other(test::model_of(test::robot_named("rhino-xr3")));
    play(one, seed, 100);
    play(other, seed, 100);
    EXPECT_EQ(one.state(), other.state()) << seed;
    EXPECT_EQ(one.events(), other.events()) << seed;
  }
}

TEST(Simulation, ARestoredStateContinuesLikeTheOriginal) {
  Simulation one(test::roomy_rhino());
  play(one, 5, 50);
  const State kept = one.state();
  play(one, 6, 50);
  Simulation other(test::roomy_rhino());
  other.restore(kept);
  play(other, 6, 50);
  EXPECT_EQ(one.state(), other.state());
}

TEST(Simulation, ResetEqualsANewSimulation) {
  Simulation simulation(test::rhino());
  play(simulation, 1, 50);
  simulation.execute(ToggleSimulator{});
  simulation.execute(SetOutput{1, true});
  simulation.set_input(1, true);
  ASSERT_FALSE(simulation.state() == initial_state(simulation.model()));
  simulation.reset();
  EXPECT_EQ(simulation.state(), initial_state(simulation.model()));
}

TEST(Simulation, EventsAreTakenOnceInOrder) {
  Rig rig(test::roomy_rhino());
  rig.move('E', 2);
  rig.move('F', 1);
  rig.pass(1000);
  const Events events = rig.simulation.take_events();
  EXPECT_EQ(events, (Events{{0, MoveTaken{'E', 2, 2}},
                            {0, MoveTaken{'F', 1, 1}},
                            {10, Reached{'F', 1}},
                            {19, Reached{'E', 2}}}));
  EXPECT_TRUE(rig.simulation.take_events().empty());
}

// E+m with D-m, as drawing programs send it: the angle between elbow and upper arm is unchanged.
TEST(Simulation, OppositeMovesKeepTheElbowAngle) {
  Rig rig(test::roomy_rhino());
  for (int i = 0; i < 4; ++i) {
    rig.move('E', 50);
    rig.move('D', -50);
    rig.settle();
  }
  EXPECT_EQ(rig.position('D'), 0);
  EXPECT_EQ(rig.position('E'), 200);
}

// A program of 1983 polls E? 25 to 41 ms after E-5, when the move must not be finished yet; another
// sends 50 counts every 240 ms without polling.
TEST(Simulation, DefaultSpeedsSuitTheOldPrograms) {
  Rig poll(test::roomy_rhino());
  poll.move('E', -5);
  poll.pass(41);
  EXPECT_NE(poll.error('E'), 0);
  for (const char label : {'D', 'C'}) {
    Rig send(test::roomy_rhino());
    for (int i = 0; i < 6; ++i) {
      send.move(label, 50);
      send.pass(240);
    }
    send.settle();
    EXPECT_EQ(send.count(label), 300) << label;
  }
}

}  // namespace
}  // namespace xr3
