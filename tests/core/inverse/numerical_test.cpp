// Numerical inverse kinematics: fictitious robots with too few joints, as many as needed and one
// too many; and the numerical method compared with the closed forms.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/inverse/inverse.hpp"
#include "core/inverse/solvers.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using test::model_of;
using test::odd_arm;
using test::robot_named;

ToolTarget pose_at(const Robot& robot, const JointVariables& variables) {
  const Transform pose = tool_transform_at(robot, variables);
  return pose_target(pose.block<3, 1>(0, 3), pose.block<3, 3>(0, 0));
}

JointVariables arbitrary_variables(const Robot& robot) {
  JointVariables variables;
  for (const Joint& joint : robot.joints) {
    const double low = std::max(joint.drive.min, joint.drive.home - 150);
    const double high = std::min(joint.drive.max, joint.drive.home + 150);
    variables.push_back(low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0);
  }
  return variables;
}

bool has(const Robot& robot, const InverseResult& result, const JointVariables& variables) {
  return std::any_of(result.solutions.begin(), result.solutions.end(),
                     [&](const InverseSolution& solution) {
                       for (std::size_t k = 0; k < variables.size(); ++k) {
                         const double apart = solution.variables[k] - variables[k];
                         const bool turns = robot.joints[k].variable == JointVariable::kTheta;
                         if (std::abs(turns ? std::remainder(apart, 360) : apart) > 1e-3)
                           return false;
                       }
                       return true;
                     });
}

RC_GTEST_PROP(InverseNumerical, ThreeJointsRoundTrip, ()) {
  const ModelPtr model = model_of(odd_arm(3));
  const JointVariables variables = arbitrary_variables(model->robot());
  const InverseResult result = solve_inverse(*model, pose_at(model->robot(), variables));
  RC_ASSERT(result.method == InverseMethod::kNumerical);
  RC_ASSERT(has(model->robot(), result, variables));
  for (const InverseSolution& solution : result.solutions) RC_ASSERT(solution.exact.mm < 1e-6);
}

TEST(InverseNumerical, ThreeJointsReachATipWithoutAnApproach) {
  const ModelPtr model = model_of(odd_arm(3));
  const Eigen::Vector3d tip = tool_transform_at(model->robot(), {-20, 70, 30}).block<3, 1>(0, 3);
  const InverseResult result = solve_inverse(*model, tip_target(tip));
  EXPECT_TRUE(has(model->robot(), result, {-20, 70, 30}));
  for (const InverseSolution& solution : result.solutions) {
    EXPECT_LT(solution.exact.mm, 1e-6);
    EXPECT_EQ(solution.exact.deg, 0);
  }
}

TEST(InverseNumerical, ThreeJointsCannotReachEveryPose) {
  const ModelPtr model = model_of(odd_arm(3));
  const InverseResult result = solve_inverse(*model, down_target({10, 20, 90}, 0));
  EXPECT_EQ(result.refusal, InverseRefusal::kNotFound);
  EXPECT_TRUE(result.solutions.empty());
  EXPECT_GT(result.off_mm + result.off_deg, 1);
}

TEST(InverseNumerical, SevenJointsAreRedundant) {
  const ModelPtr model = model_of(odd_arm(7));
  JointVariables variables = home_variables(model->robot());
  for (std::size_t k = 0; k < variables.size(); ++k)
    variables[k] += 3.0 * static_cast<double>(k) - 8;
  const InverseResult result = solve_inverse(*model, pose_at(model->robot(), variables));
  ASSERT_EQ(result.freedoms, std::vector{InverseFreedom::kMoreThanNeeded});
  ASSERT_EQ(result.solutions.size(), 8u);
  for (const InverseSolution& solution : result.solutions) {
    EXPECT_LT(solution.exact.mm, 1e-6);
    EXPECT_LT(solution.exact.deg, 1e-6);
  }
}

TEST(InverseNumerical, IsDeterministic) {
  const ModelPtr model = model_of(odd_arm(6));
  const ToolTarget target = pose_at(model->robot(), home_variables(model->robot()));
  const InverseResult once = solve_inverse(*model, target);
  const InverseResult again = solve_inverse(*model, target);
  ASSERT_FALSE(once.solutions.empty());
  ASSERT_EQ(once.solutions.size(), again.solutions.size());
  for (std::size_t i = 0; i < once.solutions.size(); ++i) {
    EXPECT_EQ(once.solutions[i].variables, again.solutions[i].variables);
  }
}

TEST(InverseNumerical, AConfigurationDeterminesTheLastJoint) {
  const ModelPtr model = model_of(odd_arm(6));
  JointVariables variables = home_variables(model->robot());
  variables.back() += 12.5;
  const InverseResult result = solve_inverse(
      *model,
      configuration_target(model->robot(), tool_configuration_at(model->robot(), variables)));
  ASSERT_FALSE(result.solutions.empty());
  for (const InverseSolution& solution : result.solutions) {
    EXPECT_NEAR(solution.variables.back(), variables.back(), 1e-9);
    EXPECT_LT(solution.exact.mm, 1e-6);
    EXPECT_LT(solution.exact.deg, 1e-6);
  }
}

// The closed forms list all solutions, so the numerical ones must be among them.
TEST(InverseNumerical, FindsOnlySolutionsOfTheClosedForms) {
  const ToolTarget targets[] = {down_target({330, 96, 60}, 25), down_target({470, 120, 100}, 35)};
  for (const char* name : {"rhino-xr3", "intelledex-660"}) {
    const ModelPtr model = model_of(robot_named(name));
    for (const ToolTarget& target : targets) {
      const InverseResult closed = solve_inverse(*model, target);
      const auto numerical = inverse::solve_numerically(model->robot(), target, {});
      EXPECT_EQ(numerical.list.empty(), closed.solutions.empty()) << name;
      for (const inverse::Candidate& candidate : numerical.list) {
        EXPECT_TRUE(has(model->robot(), closed, candidate.variables)) << name;
      }
      EXPECT_GE(2 * numerical.list.size(), closed.solutions.size())
          << name << " finds most of them";
    }
  }
}

}  // namespace
}  // namespace xr3
