// Inverse kinematics in closed form: the form of each robot, names of branches, impossible poses,
// limits, and poses that leave joints free.
#include "core/inverse/inverse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "tests/core/inverse/words.hpp"

namespace xr3 {
namespace {

using namespace test;

TEST(Inverse, TheDenavitHartenbergRowsSelectTheMethod) {
  EXPECT_EQ(inverse_method(robot_named(kRhino)), InverseMethod::kFiveAxisArm);
  EXPECT_EQ(inverse_method(robot_named(kAdept)), InverseMethod::kScara);
  EXPECT_EQ(inverse_method(robot_named(kIntelledex)), InverseMethod::kSixAxisArm);
  EXPECT_EQ(inverse_method(test::odd_arm(5)), InverseMethod::kNumerical);
  EXPECT_EQ(inverse_method(test::odd_arm(1)), InverseMethod::kNumerical);
  Robot crooked = robot_named(kRhino);
  crooked.joints[2].dh.alpha_deg = 1;
  EXPECT_EQ(inverse_method(crooked), InverseMethod::kNumerical);
  Robot bent_shoulder = robot_named(kIntelledex);
  bent_shoulder.joints[0].dh.a_mm = 10;
  EXPECT_EQ(inverse_method(bent_shoulder), InverseMethod::kNumerical);
}

std::vector<std::string> branches(const InverseResult& result) {
  std::vector<std::string> names;
  for (const InverseSolution& solution : result.solutions) names.push_back(solution.branch);
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Inverse, BranchNamesAreUnique) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(branches(solve_inverse(*model_named(kRhino), down_target({100, 0, 250}, 0))),
            (Names{"back, elbow down", "back, elbow up", "front, elbow down", "front, elbow up"}));
  EXPECT_EQ(branches(solve_inverse(*model_named(kRhino), down_target({450, 0, 50}, 0))),
            (Names{"front, elbow down", "front, elbow up"}));
  EXPECT_EQ(branches(solve_inverse(*model_named(kAdept), down_target({560, 0, 520}, 0))),
            (Names{"elbow left", "elbow right"}));
  EXPECT_EQ(branches(solve_inverse(*model_named(kIntelledex), down_target({470, 120, 15}, 35))),
            (Names{"back, roll +, elbow down", "back, roll +, elbow up", "back, roll -, elbow down",
                   "back, roll -, elbow up", "front, roll +, elbow down", "front, roll +, elbow up",
                   "front, roll -, elbow down", "front, roll -, elbow up"}));
}

TEST(Inverse, ElbowNamesMatchTheGeometry) {
  const Model& model = *model_named(kAdept);
  for (const InverseSolution& solution :
       solve_inverse(model, down_target({560, 0, 520}, 0)).solutions) {
    const auto frames = base_transforms_at(model.robot(), solution.variables);
    EXPECT_EQ(frames[1](1, 3) > 0, solution.branch == "elbow left") << solution.branch;
  }
  const Model& rhino = *model_named(kRhino);
  for (const InverseSolution& solution :
       solve_inverse(rhino, down_target({330, 96, 15}, 25)).solutions) {
    const auto frames = base_transforms_at(rhino.robot(), solution.variables);
    const double between = (frames[1](2, 3) + frames[3](2, 3)) / 2;
    EXPECT_EQ(frames[2](2, 3) > between, solution.branch.ends_with("elbow up")) << solution.branch;
  }
}

// ---------------------------------------------------------------- impossible poses

struct Refused {
  const char* what;
  const char* robot;
  ToolTarget target;
  InverseRefusal refusal;
  double off_mm;
  double off_deg;
};

const double kRhinoReach = 2 * 228.6;

TEST(Inverse, RejectsAnUnreachablePoseWithItsDistance) {
  const Refused cases[] = {
      {"too far out", kRhino, down_target({9.5 + kRhinoReach + 12.5, 0, 260.4 - 168.3}, 0),
       InverseRefusal::kTooFar, 12.5, 0},
      {"approach to the side", kRhino, yaw_pitch_roll_target({300, 0, 200}, {0, 0, 170}),
       InverseRefusal::kApproachOutOfPlane, 0, 10},
      {"approach sideways", kRhino, pointing_target({0, 300, 200}, {1, 0, 0}, 0),
       InverseRefusal::kApproachOutOfPlane, 0, 90},
      {"a leaning SCARA", kAdept, yaw_pitch_roll_target({560, 0, 520}, {0, 5, 180}),
       InverseRefusal::kApproachNotVertical, 0, 5},
      {"a SCARA upside down", kAdept, yaw_pitch_roll_target({560, 0, 520}, {0, 0, 0}),
       InverseRefusal::kApproachNotVertical, 0, 180},
      {"too far for the SCARA", kAdept, down_target({0, 803, 520}, 0), InverseRefusal::kTooFar, 3,
       0},
      {"inside the folded SCARA", kAdept, down_target({0, 45, 520}, 0), InverseRefusal::kTooNear, 5,
       0},
      {"too far for six axes", kIntelledex, down_target({0, 0, 373.4 - 228.6 - 609.6 - 7}, 0),
       InverseRefusal::kTooFar, 7, 0},
      {"a tip alone", kRhino, tip_target({300, 0, 20}), InverseRefusal::kNeedsOrientation, 0, 0},
  };
  for (const Refused& refused : cases) {
    const InverseResult result = solve_inverse(*model_named(refused.robot), refused.target);
    EXPECT_TRUE(result.solutions.empty()) << refused.what;
    EXPECT_EQ(result.refusal, refused.refusal) << refused.what;
    EXPECT_NEAR(result.off_mm, refused.off_mm, 1e-9) << refused.what;
    EXPECT_NEAR(result.off_deg, refused.off_deg, 1e-9) << refused.what;
  }
}

TEST(Inverse, RejectsATipNearerToTheAxisThanTheOffset) {
  Robot robot = robot_named(kRhino);
  robot.joints[1].dh.d_mm = 40;
  const ModelPtr model = model_of(robot);
  EXPECT_EQ(inverse_method(robot), InverseMethod::kFiveAxisArm);
  const InverseResult result = solve_inverse(*model, down_target({0, 30, 200}, 0));
  EXPECT_EQ(result.refusal, InverseRefusal::kTooNearAxis);
  EXPECT_NEAR(result.off_mm, 10, 1e-9);
}

TEST(Inverse, AToleranceAllowsATiltedApproach) {
  const Model& model = *model_named(kRhino);
  const ToolTarget leaning = yaw_pitch_roll_target({300, 0, 200}, {0, 0, 178});
  EXPECT_TRUE(solve_inverse(model, leaning, {1.9, 1e-6}).solutions.empty());
  const InverseResult result = solve_inverse(model, leaning, {2.1, 1e-6});
  ASSERT_FALSE(result.solutions.empty());
  for (const InverseSolution& solution : result.solutions) {
    EXPECT_NEAR(solution.exact.deg, 2, 1e-6);
    EXPECT_LT(solution.exact.mm, 1e-9);
  }
}

TEST(Inverse, AToleranceMovesTheTipToTheEdgeOfReach) {
  const Model& model = *model_named(kAdept);
  const InverseResult result = solve_inverse(model, down_target({800.5, 0, 520}, 0), {0.01, 1});
  ASSERT_EQ(result.solutions.size(), 1u);
  EXPECT_EQ(result.solutions[0].branch, "elbow straight");
  EXPECT_NEAR(result.solutions[0].exact.mm, 0.5, 1e-9);
}

TEST(Inverse, LimitsAndTheRegionRejectWithTheExcess) {
  const Model& model = *model_named(kAdept);
  const InverseResult high = solve_inverse(model, down_target({560, 0, 700}, 0));
  ASSERT_FALSE(high.solutions.empty());
  for (const InverseSolution& solution : high.solutions) {  // d = -23 mm, 46 counts too high
    ASSERT_EQ(solution.beyond.size(), 1u);
    EXPECT_EQ(solution.beyond[0].joint, 2);
    EXPECT_EQ(solution.beyond[0].counts, 46);
    EXPECT_DOUBLE_EQ(solution.beyond[0].amount, 23);
    EXPECT_FALSE(solution.is_allowed());
  }
  const InverseResult low = solve_inverse(*model_named(kRhino), down_target({99, 0, 200}, 0));
  ASSERT_FALSE(low.solutions.empty());
  EXPECT_TRUE(low.solutions[0].in_protected_region);
  EXPECT_FALSE(low.solutions[0].is_allowed());
}

TEST(Inverse, AFullTurnBringsAnAngleWithinLimits) {
  const Model& model = *model_named(kAdept);
  for (const double yaw : {-170.0, -90.0, 0.0, 30.0, 130.0, 180.0}) {
    for (const InverseSolution& solution :
         solve_inverse(model, down_target({300, 0, 520}, yaw)).solutions) {
      EXPECT_LE(std::abs(solution.variables[3]), 277.1);
      EXPECT_LT(solution.exact.mm, 1e-9);
    }
  }
  Robot narrow = robot_named(kAdept);  // roll 200...300 only: -140 is taken as 220
  narrow.joints[3].drive.min = 200;
  narrow.joints[3].drive.max = 300;
  const ModelPtr narrow_model = model_of(narrow);
  const InverseResult result = solve_inverse(*narrow_model, down_target({560, 0, 520}, 90));
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_NEAR(result.solutions[0].variables[3], 220.65, 0.01);
}

// ---------------------------------------------------------------- free joints

bool leaves_free(const InverseResult& result, InverseFreedom freedom) {
  return std::count(result.freedoms.begin(), result.freedoms.end(), freedom) == 1;
}

TEST(Inverse, ATipAndHandOnTheBaseAxisLeaveBaseAndRollFree) {
  const Model& model = *model_named(kRhino);
  const InverseResult result = solve_inverse(model, down_target({0, 0, 400}, 30));
  EXPECT_TRUE(leaves_free(result, InverseFreedom::kBaseAndRoll));
  ASSERT_EQ(result.solutions.size(), 4u);
  for (const InverseSolution& solution : result.solutions) {
    EXPECT_LT(solution.exact.mm, 1e-9);
    EXPECT_LT(solution.exact.deg, 1e-9);
  }
}

// Only the tip is on the axis, so the approach determines the base angle.
TEST(Inverse, ATipOnTheBaseAxisGetsTheBaseFromTheApproach) {
  const Model& model = *model_named(kRhino);
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  const InverseResult result =
      solve_inverse(model, pointing_target({0, 0, 500}, {c, s, -0.5}, -90));
  EXPECT_TRUE(result.freedoms.empty());
  ASSERT_FALSE(result.solutions.empty());
  for (const InverseSolution& solution : result.solutions) {
    EXPECT_LT(solution.exact.mm, 1e-9);
    EXPECT_NEAR(std::abs(std::sin(solution.variables[0] * kPi / 180 - 0.7)), 0, 1e-12);
  }
}

TEST(Inverse, AStretchedSixAxisArmLeavesItsPlaneFree) {
  const Model& model = *model_named(kIntelledex);
  const Transform home = tool_transform(model, Positions{});
  const InverseResult result =
      solve_inverse(model, pose_target(home.block<3, 1>(0, 3), home.block<3, 3>(0, 0)));
  EXPECT_TRUE(leaves_free(result, InverseFreedom::kArmPlane));
  ASSERT_EQ(result.solutions.size(), 4u) << "the two elbows are one";
  EXPECT_EQ(result.solutions[0].counts.motors, Positions{}) << "the soft home is among them";
}

TEST(Inverse, ALevelSixAxisArmAlignsBaseAndShoulderPitch) {
  const Model& model = *model_named(kIntelledex);
  const Transform pose = tool_transform_at(model.robot(), {90, 0, 60, 40, 50, 10});
  const InverseResult result =
      solve_inverse(model, pose_target(pose.block<3, 1>(0, 3), pose.block<3, 3>(0, 0)));
  EXPECT_TRUE(leaves_free(result, InverseFreedom::kShoulderAxes));
  ASSERT_EQ(result.solutions.size(), 4u);
  EXPECT_LT(apart(model, nearest_to(model, result, {90, 0, 60, 40, 50, 10})->variables,
                  {90, 0, 60, 40, 50, 10}),
            1e-9)
      << "the base is taken at its home, 90";
}

TEST(Inverse, AFoldedArmHasAFreeJoint) {
  const Model& model = *model_named(kRhino);
  const InverseResult result = solve_inverse(model, down_target({9.5, 0, 260.4 - 168.3}, 0));
  EXPECT_TRUE(leaves_free(result, InverseFreedom::kFolded));
  ASSERT_FALSE(result.solutions.empty());
  for (const InverseSolution& solution : result.solutions) EXPECT_LT(solution.exact.mm, 1e-9);
}

TEST(Inverse, SolvesASixAxisArmWithItsWristOnTheShoulder) {
  const Model& model = *model_named(kIntelledex);
  for (const Eigen::Vector3d& approach :
       {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0.6, 0, 0.8), Eigen::Vector3d(0, 1, 0)}) {
    const Eigen::Vector3d tip = Eigen::Vector3d(0, 0, 373.4) + 228.6 * approach;
    const InverseResult result = solve_inverse(model, pointing_target(tip, approach, 15));
    EXPECT_TRUE(leaves_free(result, InverseFreedom::kFolded));
    ASSERT_FALSE(result.solutions.empty());
    for (const InverseSolution& solution : result.solutions) {
      EXPECT_LT(solution.exact.mm, 1e-6);
      EXPECT_LT(solution.exact.deg, 1e-6);
    }
  }
}

}  // namespace
}  // namespace xr3
