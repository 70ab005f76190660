// Positions from counts and counts from positions (paper, Section II-B).
#include "core/coupling.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::LabelledCount;
using test::model_of;
using test::positions_at;
using test::rhino;
using test::robot_named;

struct CouplingCase {
  const char* what;
  std::initializer_list<LabelledCount> counts;
  Positions positions;  // F E D C B A
};

const CouplingCase kCases[] = {
    {"home", {}, {0, 0, 0, 0, 0, 0}},
    {"the base moves alone", {{'F', 90}}, {90, 0, 0, 0, 0, 0}},
    {"the shoulder moves the elbow, and not the pitch", {{'E', 50}}, {0, 50, 50, 0, 0, 0}},
    {"the elbow moves the pitch the other way", {{'D', 50}}, {0, 0, 50, -50, 0, 0}},
    {"the pitch moves alone", {{'C', 50}}, {0, 0, 0, 50, 0, 0}},
    {"the roll moves alone", {{'B', 50}}, {0, 0, 0, 0, 50, 0}},
    {"the jaws move alone", {{'A', 5}}, {0, 0, 0, 0, 0, 5}},
    {"E+m with D-m keeps the elbow's angle", {{'E', 40}, {'D', -40}}, {0, 40, 0, 40, 0, 0}},
    {"all at once",
     {{'F', 90}, {'E', 40}, {'D', -60}, {'C', 30}, {'B', 48}, {'A', -7}},
     {90, 40, -20, 90, 48, -7}},
};

TEST(Coupling, PositionsOfTheRhino) {
  for (const CouplingCase& wanted : kCases) {
    EXPECT_EQ(positions_at(*rhino(), wanted.counts), wanted.positions) << wanted.what;
  }
}

TEST(Coupling, OnePositionEqualsThatOfAllPositions) {
  const State state = test::state_at(*rhino(), {{'F', 3}, {'E', 40}, {'D', -60}, {'C', 30}});
  const Positions all = positions(*rhino(), state.motors);
  for (int i = 0; i < rhino()->motor_count(); ++i) {
    EXPECT_EQ(position(*rhino(), state.motors, i), all[static_cast<std::size_t>(i)]) << i;
  }
}

// A chain of couplings in either order, signs and directions at random.
Robot coupled_arm() {
  Robot robot = test::odd_arm(7);
  const bool outwards = *rc::gen::arbitrary<bool>();
  for (int joint = 0; joint + 1 < 7; ++joint) {
    if (*rc::gen::inRange(0, 3) == 0) continue;
    const int sign = *rc::gen::element(1, -1);
    if (outwards) {
      robot.couplings.push_back({joint, *rc::gen::inRange(joint + 1, 7), sign});
    } else {
      robot.couplings.push_back({joint + 1, *rc::gen::inRange(0, joint + 1), sign});
    }
  }
  return robot;
}

RC_GTEST_PROP(Coupling, CountsAreTheInverseOfPositions, ()) {
  const ModelPtr model = model_of(coupled_arm());
  Motors motors;
  Positions counts{};
  for (int i = 0; i < model->motor_count(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    counts[index] = *rc::gen::inRange(-5000, 5000);
    motors[index].count = counts[index];
  }
  RC_ASSERT(motor_counts(*model, positions(*model, motors)) == counts);
}

RC_GTEST_PROP(Coupling, TurningCountByCountEqualsTurningAtOnce, ()) {
  const ModelPtr model = model_of(coupled_arm());
  const int motor = *rc::gen::inRange(0, model->motor_count());
  const Counts counts = *rc::gen::inRange(-200, 200);
  Positions stepwise{};
  for (Counts i = 0; i < std::abs(counts); ++i) turn(*model, stepwise, motor, counts < 0 ? -1 : 1);
  Positions at_once{};
  turn(*model, at_once, motor, counts);
  RC_ASSERT(stepwise == at_once);
}

}  // namespace
}  // namespace xr3
