// The values that the model computes from the files: limits in whole counts, coupling between
// counts, labels, the profile's switches.
#include "core/model.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using test::model_of;
using test::rhino;
using test::robot_named;

struct LimitCase {
  const char* robot;
  char label;
  CountRange limits;
};

// Computed by exact rational arithmetic from the figures in degrees and millimetres. Most limits
// lie exactly on a count, where a double may be on either side.
constexpr LimitCase kLimits[] = {
    {"rhino-xr3", 'F', {-771, 771}},         {"rhino-xr3", 'E', {-440, 881}},
    {"rhino-xr3", 'D', {-660, 925}},         {"rhino-xr3", 'C', {-1101, 1101}},
    {"rhino-xr3", 'B', {-1151712, 1152288}}, {"rhino-xr3", 'A', {-16, 64}},
    {"adept-one", 'E', {-1500, 1500}},       {"adept-one", 'D', {-1470, 1470}},
    {"adept-one", 'C', {-200, 190}},         {"adept-one", 'B', {-1174, 598}},
    {"adept-one", 'A', {-40, 120}},          {"intelledex-660", 'G', {-1500, 1500}},
    {"intelledex-660", 'F', {-1500, 1500}},  {"intelledex-660", 'E', {-1200, 1200}},
    {"intelledex-660", 'D', {-1500, 1500}},  {"intelledex-660", 'C', {-1200, 1200}},
    {"intelledex-660", 'B', {-1152, 1152}},  {"intelledex-660", 'A', {-40, 80}},
};

TEST(Model, LimitsAreCountsRoundedInwards) {
  for (const LimitCase& wanted : kLimits) {
    const ModelPtr model = model_of(robot_named(wanted.robot));
    const MotorModel& motor = model->motor(model->index_of(wanted.label));
    EXPECT_EQ(motor.low, wanted.limits.low) << wanted.robot << " " << wanted.label;
    EXPECT_EQ(motor.high, wanted.limits.high) << wanted.robot << " " << wanted.label;
  }
}

TEST(Model, ALimitMayBeAMillionthOfACountShort) {
  Drive drive;
  drive.precision = 0.1;
  drive.max = 1.0;
  EXPECT_EQ(count_limits(drive), (CountRange{0, 10}));
  drive.max = 0.99999995;
  EXPECT_EQ(count_limits(drive), (CountRange{0, 10}));
  drive.max = 0.999999;
  EXPECT_EQ(count_limits(drive), (CountRange{0, 9}));
  drive.direction = -1;
  EXPECT_EQ(count_limits(drive), (CountRange{-9, 0}));
}

TEST(Model, LabelsGoFromTheToolToTheBase) {
  const ModelPtr model = rhino();
  EXPECT_EQ(model->joint_count(), 5);
  EXPECT_EQ(model->motor_count(), 6);
  EXPECT_EQ(model->tool_index(), 5);
  const std::pair<char, int> labels[] = {{'A', 5}, {'B', 4},  {'C', 3},  {'D', 2},  {'E', 1},
                                         {'F', 0}, {'G', -1}, {'H', -1}, {'@', -1}, {'Z', -1}};
  for (const auto& [label, index] : labels) EXPECT_EQ(model->index_of(label), index) << label;
}

TEST(Model, LabelsAreLettersInAnyOrder) {
  Robot robot = robot_named("rhino-xr3");
  const std::string letters = "CHBGE";
  for (std::size_t i = 0; i < letters.size(); ++i) robot.joints[i].drive.label = letters[i];
  const ModelPtr model = model_of(robot);
  for (std::size_t i = 0; i < letters.size(); ++i)
    EXPECT_EQ(model->index_of(letters[i]), static_cast<int>(i)) << letters[i];
  EXPECT_EQ(model->index_of('A'), model->tool_index());
  EXPECT_EQ(model->index_of('D'), -1);
  EXPECT_EQ(model->index_of('F'), -1);
  EXPECT_EQ(model->labels(), "ABCEGH");
}

// As joint variables: shoulder against elbow, elbow against pitch. E counts with its variable, D
// and C against theirs. Between counts, D therefore gains the counts of E, and C loses the counts
// of D.
TEST(Model, CouplingOfTheRhinoBetweenCounts) {
  const ModelPtr model = rhino();
  const int e = model->index_of('E');
  const int d = model->index_of('D');
  const int c = model->index_of('C');
  for (int joint = 0; joint < model->motor_count(); ++joint) {
    for (int motor = 0; motor < model->motor_count(); ++motor) {
      int wanted = joint == motor ? 1 : 0;
      if (joint == d && motor == e) wanted = 1;
      if (joint == c && motor == d) wanted = -1;
      EXPECT_EQ(model->gain(joint, motor), wanted) << "joint " << joint << ", motor " << motor;
    }
  }
  EXPECT_EQ(model->driven_by(e), (std::vector<CoupledJoint>{{1, 1}, {2, 1}}));
  EXPECT_EQ(model->driven_by(d), (std::vector<CoupledJoint>{{2, 1}, {3, -1}}));
  EXPECT_EQ(model->driven_by(c), (std::vector<CoupledJoint>{{3, 1}}));
}

TEST(Model, TheGainOfACouplingDependsOnDirectionsAndSign) {
  for (const int sign : {1, -1}) {
    for (const int turning : {1, -1}) {
      for (const int turned : {1, -1}) {
        Robot robot = robot_named("rhino-xr3");
        robot.couplings = {{1, 2, sign}};
        robot.joints[1].drive.direction = turning;
        robot.joints[2].drive.direction = turned;
        EXPECT_EQ(model_of(robot)->gain(2, 1), sign * turning * turned);
      }
    }
  }
}

TEST(Model, VariablesChangeFromHomeByPrecisionAndDirection) {
  const ModelPtr model = rhino();
  EXPECT_DOUBLE_EQ(model->variable(model->index_of('F'), 90), 20.421);
  EXPECT_DOUBLE_EQ(model->variable(model->index_of('E'), 40), -85.46);
  EXPECT_DOUBLE_EQ(model->variable(model->index_of('D'), -20), 92.27);
  EXPECT_DOUBLE_EQ(model->variable(model->index_of('C'), 90), -10.215);
  EXPECT_DOUBLE_EQ(model->variable(model->index_of('B'), 48), -75.0);
  EXPECT_DOUBLE_EQ(model->variable(model->index_of('A'), 64), 0.0);
  EXPECT_DOUBLE_EQ(model->variable(model->index_of('A'), -16), 63.5);
}

TEST(Model, TheProfileSetsTheRangeOfSwitchesWithoutAWidth) {
  Robot robot = robot_named("rhino-xr3");
  robot.joints[0].drive.microswitch.width = 7;
  const ModelPtr paper = model_of(robot, Profile::kPaper);
  const ModelPtr mark3 = model_of(robot, Profile::kMark3);
  EXPECT_EQ(paper->motor(0).closed, (CountRange{27, 33}));
  EXPECT_EQ(mark3->motor(0).closed, (CountRange{27, 33}));
  EXPECT_EQ(paper->motor(1).closed, (CountRange{std::numeric_limits<Counts>::min(), -40}));
  EXPECT_EQ(mark3->motor(1).closed, (CountRange{-100, -40}));
}

TEST(Model, TheRegionIsRoundedToMicrometres) {
  EXPECT_EQ(rhino()->region_radius_um(), 100'000);
  EXPECT_EQ(rhino()->region_height_um(), 340'000);
}

TEST(Units, LengthsAndAnglesRoundHalvesAwayFromZero) {
  EXPECT_EQ(micrometres(0.0004999), 0);
  EXPECT_EQ(micrometres(0.0005), 1);
  EXPECT_EQ(micrometres(-0.0005), -1);
  EXPECT_EQ(micrometres(238.1), 238'100);
  EXPECT_EQ(microdegrees(-37.5000005), -37'500'001);
}

}  // namespace
}  // namespace xr3
