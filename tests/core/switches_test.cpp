// Microswitches: closed beyond their position or with a finite width, driven by the motor and not
// the joint; the bits of I, J and K.
#include "core/switches.hpp"

#include <gtest/gtest.h>

#include "core/home.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::Rig;
using test::roomy_rhino;

struct ClosedCase {
  Microswitch microswitch;
  CountRange paper;  ///< of the counts -1000...1000
  CountRange mark3;
};

constexpr Counts kFar = 1000;

void expect_closed(const Microswitch& microswitch, Profile profile, const CountRange& wanted) {
  const MotorModel motor{{}, 0, 0, closed_range(microswitch, profile), 0};
  for (Counts count = -kFar; count <= kFar; ++count) {
    ASSERT_EQ(is_closed(motor, count), count >= wanted.low && count <= wanted.high)
        << "position " << microswitch.position << ", count " << count;
  }
}

TEST(Switches, AreClosedAtTheseCounts) {
  const ClosedCase cases[] = {
      {{30, 8, {}, {}}, {30, kFar}, {30, 90}}, {{-40, 4, {}, {}}, {-kFar, -40}, {-100, -40}},
      {{1, 1, {}, {}}, {1, kFar}, {1, 61}},    {{-1, 1, {}, {}}, {-kFar, -1}, {-61, -1}},
      {{30, 8, 60, {}}, {0, 60}, {0, 60}},     {{-40, 4, 60, {}}, {-70, -10}, {-70, -10}},
      {{40, 2, 7, {}}, {37, 43}, {37, 43}},    {{40, 2, 1, {}}, {40, 40}, {40, 40}},
      {{40, 2, 0, {}}, {40, 40}, {40, 40}},    {{40, 2, 2, {}}, {39, 41}, {39, 41}},
      {{0, 2, 9, {}}, {-4, 4}, {-4, 4}},
  };
  for (const ClosedCase& wanted : cases) {
    expect_closed(wanted.microswitch, Profile::kPaper, wanted.paper);
    expect_closed(wanted.microswitch, Profile::kMark3, wanted.mark3);
  }
}

struct TravelCase {
  char label;
  int away;  ///< sign of the direction towards the switch
  Counts closes;
};

// F closes at +30, E at -40, D and C at +40, B at -25, A at -16.
constexpr TravelCase kTravels[] = {{'F', 1, 30}, {'E', -1, -40}, {'D', 1, 40},
                                   {'C', 1, 40}, {'B', -1, -25}, {'A', -1, -16}};

TEST(Switches, EachClosesAtItsPositionAndOpensOnTheWayBack) {
  for (const auto& [label, away, closes] : kTravels) {
    Rig rig(roomy_rhino());
    const Counts far = label == 'A' ? -16 : closes + away * 50;
    rig.travel(label, far);
    EXPECT_EQ(rig.count(label), far) << label;
    EXPECT_TRUE(rig.motor(label).switch_closed) << label;
    rig.travel(label, -far);
    EXPECT_EQ(rig.events_of<SwitchChanged>(),
              (std::vector<SwitchChanged>{{label, true, closes}, {label, false, closes - away}}))
        << label;
  }
}

TEST(Switches, OfTheMark3CloseAtTheSamePositionsAndOpenSixtyCountsBeyond) {
  for (const auto& [label, away, closes] : kTravels) {
    Rig rig(roomy_rhino(Profile::kMark3));
    EXPECT_FALSE(rig.motor(label).switch_closed) << label << " at the soft home";
    if (label == 'A') continue;  // its switch is at the limit
    rig.travel(label, closes + away * 100);
    EXPECT_EQ(
        rig.events_of<SwitchChanged>(),
        (std::vector<SwitchChanged>{{label, true, closes}, {label, false, closes + away * 61}}))
        << label;
  }
}

// B closes at -25, and once more a turn later, 1152 counts.
TEST(Switches, OfTheMark3RepeatAfterTheirPeriod) {
  const ModelPtr model = test::rhino(Profile::kMark3);
  const MotorModel& roll = model->motor(model->index_of('B'));
  for (const Counts turn : {-1152 * 900, -2304, -1152, 0, 1152, 2304, 1152 * 900}) {
    EXPECT_FALSE(is_closed(roll, turn - 86)) << turn;
    EXPECT_TRUE(is_closed(roll, turn - 85)) << turn;
    EXPECT_TRUE(is_closed(roll, turn - 25)) << turn;
    EXPECT_FALSE(is_closed(roll, turn - 24)) << turn;
  }
}

TEST(Switches, OfThePaperDoNotRepeat) {
  const ModelPtr model = test::rhino();
  const MotorModel& roll = model->motor(model->index_of('B'));
  EXPECT_TRUE(is_closed(roll, -25 - 100));
  EXPECT_FALSE(is_closed(roll, 1152 - 25));
}

TEST(Switches, TurnedEitherWayTheRollOfTheMark3MeetsItsSwitch) {
  for (const int way : {1, -1}) {
    Rig rig(roomy_rhino(Profile::kMark3));
    for (int steps = 0; !rig.motor('B').switch_closed; ++steps) {
      ASSERT_LT(steps, 60) << way;
      rig.travel('B', way * 20);
    }
  }
}

TEST(Switches, FollowTheMotorAndNotTheCoupledJoint) {
  Rig rig(roomy_rhino());
  rig.travel('E', 100);
  EXPECT_EQ(rig.position('D'), 100);
  EXPECT_EQ(rig.count('D'), 0);
  EXPECT_FALSE(rig.motor('D').switch_closed);
  EXPECT_TRUE(rig.events_of<SwitchChanged>().empty());
}

TEST(Switches, MatchTheirCountsAtTheStart) {
  Robot robot = test::robot_named("rhino-xr3");
  robot.joints[0].drive.microswitch = {0, 8, 10, {}};
  const Rig rig(test::model_of(robot));
  EXPECT_TRUE(rig.motor('F').switch_closed);
  EXPECT_FALSE(rig.motor('E').switch_closed);
}

TEST(Switches, AreUpdatedForTheGivenMotorsOnly) {
  const ModelPtr model = roomy_rhino();
  State state = initial_state(*model);
  for (int i = 0; i < model->motor_count(); ++i) {
    const CountRange closed = model->motor(i).closed;
    state.motor(i).count = closed.low > 0 ? closed.low : closed.high;
  }
  Events events;
  update_switches(*model, state, events, bit_of(1));
  for (int i = 0; i < model->motor_count(); ++i) EXPECT_EQ(state.motor(i).switch_closed, i == 1);
  ASSERT_EQ(events.size(), 1U);
  update_switches(*model, state, events);
  EXPECT_EQ(events.size(), static_cast<std::size_t>(model->motor_count()));
}

TEST(Switches, BitsOfIAndJFollowLabelAndMask) {
  Rig rig(roomy_rhino());
  rig.stand_at({{'F', 30}, {'E', -40}, {'D', 40}, {'C', 40}, {'B', -25}, {'A', -16}});
  EXPECT_EQ(switch_bits(rig.model(), rig.state(), 'I'), (SwitchBits{15, 15, 0, 'I'}));
  EXPECT_EQ(switch_bits(rig.model(), rig.state(), 'J'), (SwitchBits{48, 48, 0, 'J'}));
  EXPECT_EQ(switch_bits(rig.model(), rig.state(), 'K'), (SwitchBits{0, 0, 0, 'K'}));
  const std::pair<char, SwitchBits> alone[] = {{'F', {8, 15, 0, 'I'}},  {'E', {4, 15, 0, 'I'}},
                                               {'D', {2, 15, 0, 'I'}},  {'C', {1, 15, 0, 'I'}},
                                               {'B', {32, 48, 0, 'J'}}, {'A', {16, 48, 0, 'J'}}};
  for (const auto& [label, bits] : alone) {
    const Counts closed = rig.model().motor(rig.model().index_of(label)).drive.microswitch.position;
    const State state = test::state_at(rig.model(), {{label, closed}});
    EXPECT_EQ(switch_bits(rig.model(), state, bits.inquiry), bits) << label;
  }
}

TEST(Switches, ALetterDecidesBetweenIAndJ) {
  Robot robot = test::robot_named("rhino-xr3");
  std::swap(robot.joints[0].drive.label, robot.joints[4].drive.label);
  robot.joints[0].drive.microswitch.mask = 2;
  robot.joints[4].drive.microswitch.mask = 8;
  Rig rig(test::model_of(robot));
  rig.stand_at({{'B', 30}});
  EXPECT_EQ(switch_bits(rig.model(), rig.state(), 'J'), (SwitchBits{2, 18, 0, 'J'}));
  EXPECT_EQ(switch_bits(rig.model(), rig.state(), 'I'), (SwitchBits{0, 15, 0, 'I'}));
}

TEST(Switches, AMaskOf0RemovesAJointFromBoth) {
  Robot robot = test::robot_named("rhino-xr3");
  robot.joints[0].drive.microswitch.mask = 0;
  const ModelPtr model = test::model_of(robot);
  const State state = test::state_at(*model, {{'F', 30}});
  EXPECT_TRUE(state.motor(0).switch_closed);
  EXPECT_EQ(switch_bits(*model, state, 'I'), (SwitchBits{0, 7, 0, 'I'}));
}

TEST(Switches, InputLinesTakeTheBitsOfJThatAAndBLeaveFree) {
  EXPECT_EQ(input_masks_of_j(16, 32), (InputMasks{1, 2, 4, 8}));
  EXPECT_EQ(input_masks_of_j(1, 8), (InputMasks{2, 4, 16, 32}));
  EXPECT_EQ(input_masks_of_j(0, 4), (InputMasks{1, 2, 8, 16}));
  const std::pair<std::uint8_t, std::uint8_t> of_version_0_1[] = {{0, 0}, {0, 1}, {1, 0}, {2, 0},
                                                                  {0, 2}, {1, 2}, {2, 1}};
  for (const auto& [a, b] : of_version_0_1)
    EXPECT_EQ(input_masks_of_j(a, b), (InputMasks{4, 8, 16, 32})) << +a << " " << +b;
}

TEST(Switches, InputLinesAreBitsOfKAndJ) {
  for (int line = 1; line <= 8; ++line) {
    Rig rig;
    rig.simulation.set_input(line, true);
    const unsigned k = line <= 4 ? 1U << static_cast<unsigned>(line - 1) : 0U;
    const unsigned j = line > 4 ? 1U << static_cast<unsigned>(line - 5) : 0U;
    EXPECT_EQ(switch_bits(rig.model(), rig.state(), 'K').inputs, k) << line;
    EXPECT_EQ(switch_bits(rig.model(), rig.state(), 'J').inputs, j) << line;
    EXPECT_EQ(switch_bits(rig.model(), rig.state(), 'I').inputs, 0) << line;
  }
}

}  // namespace
}  // namespace xr3
