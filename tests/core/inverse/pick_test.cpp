// Inverse kinematics of every pick of the three workcells and of the published poses: joint angles
// as printed, motor counts exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/inverse/inverse.hpp"
#include "tests/core/inverse/words.hpp"

namespace xr3 {
namespace {

using namespace test;

struct Pick {
  const char* robot;
  const char* block;
  Eigen::Vector3d centroid_mm;
  double yaw_deg;
  JointVariables variables;
  std::initializer_list<LabelledCount> grasp;
  std::initializer_list<LabelledCount> above;  // 100 mm higher
};

const Pick kPicks[] = {
    {kRhino,
     "red",
     {262, 0, 20},
     90,
     {0, -39.01, 109.89, -70.88, -90},
     {{'E', 449}, {'D', -625}},
     {{'E', 242}, {'D', -440}}},
    {kRhino,
     "green",
     {330, 96, 15},
     25,
     {16.22, -28.41, 82.80, -54.39, -8.78},
     {{'F', 71}, {'E', 543}, {'D', -479}, {'B', 260}},
     {{'F', 71}, {'E', 381}, {'D', -343}, {'B', 260}}},
    {kRhino,
     "blue",
     {344, -92, 15},
     140,
     {-14.97, -26.51, 78.10, -51.59, -154.97},
     {{'F', -66}, {'E', 559}, {'D', -455}, {'B', -208}},
     {{'F', -66}, {'E', 402}, {'D', -324}, {'B', -208}}},
    {kRhino,
     "yellow",
     {212, 136, 12},
     60,
     {32.68, -37.77, 112.12, -74.35, -27.32},
     {{'F', 144}, {'E', 460}, {'D', -655}, {'B', 201}},
     {{'F', 144}, {'E', 242}, {'D', -468}, {'B', 201}}},
    {kRhino,
     "magenta",
     {214, -130, 18},
     10,
     {-31.28, -39.45, 113.09, -73.65, -41.28},
     {{'F', -138}, {'E', 445}, {'D', -649}, {'B', 156}},
     {{'F', -138}, {'E', 228}, {'D', -457}, {'B', 156}}},

    {kAdept,
     "red",
     {560, 0, 520},
     90,
     {42.02, 91.38, 157, 40.65},
     {{'E', 420}, {'D', 914}, {'C', 114}, {'B', -158}},
     {{'E', 420}, {'D', 914}, {'C', -86}, {'B', -158}}},
    {kAdept,
     "green",
     {640, 140, 520},
     30,
     {44.93, 70.20, 157, -55.28},
     {{'E', 449}, {'D', 702}, {'C', 114}, {'B', -465}},
     {{'E', 449}, {'D', 702}, {'C', -86}, {'B', -465}}},
    {kAdept,
     "blue",
     {620, -150, 515},
     115,
     {20.89, 74.41, 162, 11.48},
     {{'E', 209}, {'D', 744}, {'C', 124}, {'B', -251}},
     {{'E', 209}, {'D', 744}, {'C', -76}, {'B', -251}}},
    {kAdept,
     "yellow",
     {420, 160, 515},
     70,
     {71.55, 111.97, 162, 69.58},
     {{'E', 715}, {'D', 1120}, {'C', 124}, {'B', -65}},
     {{'E', 715}, {'D', 1120}, {'C', -76}, {'B', -65}}},
    {kAdept,
     "magenta",
     {430, -140, 525},
     160,
     {32.47, 111.49, 152, -59.02},
     {{'E', 325}, {'D', 1115}, {'C', 104}, {'B', -477}},
     {{'E', 325}, {'D', 1115}, {'C', -96}, {'B', -477}}},

    {kIntelledex,
     "red",
     {400, 0, 20},
     0,
     {90, -90, 119.25, -93.16, 63.91, 0},
     {{'E', 293}, {'D', -932}, {'C', -261}},
     {{'E', 453}, {'D', -978}, {'C', -376}}},
    {kIntelledex,
     "green",
     {470, 120, 15},
     35,
     {104.32, -90, 109.56, -69.08, 49.52, -20.68},
     {{'G', 143}, {'E', 196}, {'D', -691}, {'C', -405}, {'B', -66}},
     {{'G', 143}, {'E', 336}, {'D', -743}, {'C', -494}, {'B', -66}}},
    {kIntelledex,
     "blue",
     {460, -130, 15},
     110,
     {74.22, -90, 110.46, -71.31, 50.85, 54.22},
     {{'G', -158}, {'E', 205}, {'D', -713}, {'C', -392}, {'B', 174}},
     {{'G', -158}, {'E', 347}, {'D', -764}, {'C', -482}, {'B', 174}}},
    {kIntelledex,
     "yellow",
     {290, 150, 12},
     65,
     {117.35, -90, 122.54, -109.35, 76.81, -37.65},
     {{'G', 273}, {'E', 325}, {'D', -1094}, {'C', -132}, {'B', -120}},
     {{'G', 273}, {'E', 517}, {'D', -1149}, {'C', -268}, {'B', -120}}},
    {kIntelledex,
     "magenta",
     {280, -140, 18},
     160,
     {63.43, -90, 124.30, -112.71, 78.40, -6.57},
     {{'G', -266}, {'E', 343}, {'D', -1127}, {'C', -116}, {'B', -21}},
     {{'G', -266}, {'E', 541}, {'D', -1180}, {'C', -261}, {'B', -21}}},
};

/// The block's yaw, or plus half a turn, whichever matches the pick's roll: for the jaws both are
/// equal.
double net_roll_of(const Pick& pick, const Model& model) {
  const double printed = net_roll_deg_at(model.robot(), pick.variables);
  return apart_deg(printed, pick.yaw_deg) < 90 ? pick.yaw_deg : pick.yaw_deg + 180;
}

TEST(Inverse, SolvesEveryPickInAnglesAndCounts) {
  for (const Pick& pick : kPicks) {
    SCOPED_TRACE(std::string(pick.robot) + " " + pick.block);
    const Model& model = *model_named(pick.robot);
    const InverseResult result =
        solve_inverse(model, down_target(pick.centroid_mm, net_roll_of(pick, model)));
    const InverseSolution* solution = nearest_to(model, result, pick.variables);
    ASSERT_NE(solution, nullptr);
    for (std::size_t k = 0; k < pick.variables.size(); ++k) {
      EXPECT_NEAR(solution->variables[k], pick.variables[k], 0.01) << "joint " << k + 1;
    }
    EXPECT_EQ(solution->counts.motors, motors_at(model, pick.grasp));
    EXPECT_TRUE(solution->is_allowed());
    EXPECT_LT(solution->exact.mm, 1e-9);
    EXPECT_LT(solution->rounded.mm, 1.2);
    EXPECT_LT(solution->rounded.deg, 0.3);
  }
}

TEST(Inverse, SolvesAHundredMillimetresAboveEveryPick) {
  for (const Pick& pick : kPicks) {
    SCOPED_TRACE(std::string(pick.robot) + " " + pick.block);
    const Model& model = *model_named(pick.robot);
    const Eigen::Vector3d above = pick.centroid_mm + Eigen::Vector3d(0, 0, 100);
    const InverseResult result = solve_inverse(model, down_target(above, net_roll_of(pick, model)));
    const InverseSolution* solution = nearest_to(model, result, pick.variables);
    ASSERT_NE(solution, nullptr);
    EXPECT_EQ(solution->counts.motors, motors_at(model, pick.above));
    EXPECT_TRUE(solution->is_allowed());
  }
}

struct GoldenPick {
  const char* robot;
  std::initializer_list<LabelledCount> counts;
};

const GoldenPick kGoldens[] = {
    {kRhino, {}},
    {kRhino, {{'F', 90}, {'E', 40}, {'D', -60}, {'C', 30}, {'B', 48}}},
    {kRhino, {{'F', 90}, {'E', 40}, {'D', 60}, {'C', -30}, {'B', 48}}},
    {kRhino, {{'E', 449}, {'D', -625}}},
    {kAdept, {}},
    {kAdept, {{'E', 449}, {'D', 702}, {'C', 114}, {'B', -465}}},
    {kIntelledex, {}},
    {kIntelledex, {{'G', 143}, {'E', 196}, {'D', -691}, {'C', -405}, {'B', -66}}},
};

TEST(Inverse, PublishedPosesAndConfigurationsGiveTheirCounts) {
  for (const GoldenPick& golden : kGoldens) {
    const Model& model = *model_named(golden.robot);
    const Positions positions = positions_at(model, golden.counts);
    const JointVariables variables = variables_at(model, positions);
    const Transform pose = tool_transform(model, positions);
    for (const ToolTarget& target :
         {pose_target(pose.block<3, 1>(0, 3), pose.block<3, 3>(0, 0)),
          configuration_target(model.robot(), tool_configuration(model, positions))}) {
      const InverseResult result = solve_inverse(model, target);
      const InverseSolution* solution = nearest_to(model, result, variables);
      ASSERT_NE(solution, nullptr) << golden.robot;
      EXPECT_LT(apart(model, solution->variables, variables), 1e-6) << golden.robot;
      EXPECT_EQ(solution->counts.motors, motors_at(model, golden.counts)) << golden.robot;
      EXPECT_EQ(solution->counts.positions, positions) << golden.robot;
      EXPECT_LT(solution->rounded.mm, 1e-6);
    }
  }
}

// As printed in the paper, with four decimals: the approach is 0.002 degrees out of the plane.
TEST(Inverse, AcceptsARoundedConfiguration) {
  ToolConfiguration w;
  w << 247.9346, 92.3095, 293.7373, 0.03669, 0.01366, -0.65808;
  const Model& model = *model_named(kRhino);
  const InverseResult result = solve_inverse(model, configuration_target(model.robot(), w));
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_EQ(result.solutions[0].counts.motors,
            motors_at(model, {{'F', 90}, {'E', 40}, {'D', -60}, {'C', 30}, {'B', 48}}));
  EXPECT_EQ(solve_inverse(model, configuration_target(model.robot(), w), {1e-6, 1e-6}).refusal,
            InverseRefusal::kApproachOutOfPlane);
}

TEST(Inverse, AConfigurationKeepsFullTurnsOfTheLastJoint) {
  const Model& model = *model_named(kRhino);
  const Positions turned = positions_at(model, {{'B', 1152 * 3 + 7}});
  const InverseResult result =
      solve_inverse(model, configuration_target(model.robot(), tool_configuration(model, turned)));
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_EQ(result.solutions[0].counts.positions, turned);
}

}  // namespace
}  // namespace xr3
