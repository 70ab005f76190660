// Direct after inverse kinematics over the joints' full ranges, and the error of rounding to
// counts.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

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

/// Joint variables anywhere in their ranges, without full turns, on counts or between them.
JointVariables arbitrary_variables(const Model& model) {
  JointVariables variables;
  for (int k = 0; k < model.joint_count(); ++k) {
    const Drive& drive = model.motor(k).drive;
    const double low = std::max(drive.min, drive.home - 180);
    const double high = std::min(drive.max, drive.home + 180);
    const int part = *rc::gen::resize(1000, rc::gen::inRange(0, 100'001));
    variables.push_back(low + (high - low) * part / 100'000.0);
  }
  return variables;
}

void expect_round_trip(const char* robot) {
  const Model& model = *model_named(robot);
  const JointVariables variables = arbitrary_variables(model);
  const Transform pose = tool_transform_at(model.robot(), variables);
  const auto by_pose = pose_target(pose.block<3, 1>(0, 3), pose.block<3, 3>(0, 0));
  const auto by_configuration =
      configuration_target(model.robot(), tool_configuration_at(model.robot(), variables));
  for (const ToolTarget& target : {by_pose, by_configuration}) {
    const InverseResult result = solve_inverse(model, target);
    RC_ASSERT(!result.solutions.empty());
    for (const InverseSolution& solution : result.solutions) {
      RC_ASSERT(solution.exact.mm < 1e-6);
      RC_ASSERT(solution.exact.deg < 1e-6);
    }
    if (!result.freedoms.empty()) continue;
    RC_ASSERT(apart(model, nearest_to(model, result, variables)->variables, variables) < 1e-3);
  }
}

RC_GTEST_PROP(Inverse, RhinoRoundTrips, ()) { expect_round_trip(kRhino); }
RC_GTEST_PROP(Inverse, AdeptRoundTrips, ()) { expect_round_trip(kAdept); }
RC_GTEST_PROP(Inverse, IntelledexRoundTrips, ()) { expect_round_trip(kIntelledex); }

RC_GTEST_PROP(Inverse, CountsRoundTrip, ()) {
  const Model& model = *model_named(
      *rc::gen::element(std::string(kRhino), std::string(kAdept), std::string(kIntelledex)));
  Positions positions{};
  for (int k = 0; k < model.joint_count(); ++k) {
    const Counts low = std::max(model.motor(k).low, -2000);
    const Counts high = std::min(model.motor(k).high, 2000);
    positions[static_cast<std::size_t>(k)] = *rc::gen::inRange(low, high + 1);
  }
  const NearestCounts counts = nearest_counts(model, variables_at(model, positions));
  RC_ASSERT(counts.positions == positions);
  RC_ASSERT(counts.motors == motor_counts(model, positions));
}

// The rounded pose is within half a count of each motor of the exact one.
RC_GTEST_PROP(Inverse, RoundingErrorIsAtMostHalfACountPerMotor, ()) {
  const Model& model = *model_named(kRhino);
  const JointVariables variables = arbitrary_variables(model);
  const NearestCounts counts = nearest_counts(model, variables);
  const JointVariables rounded = variables_at(model, counts.positions);
  const auto sum = [](const JointVariables& q, int joints) {
    double total = 0;
    for (int k = 1; k < joints; ++k) total += q[static_cast<std::size_t>(k)];
    return total;
  };
  for (const int joints : {2, 3, 4}) {  // slopes of upper arm, forearm and hand
    RC_ASSERT(std::abs(sum(rounded, joints) - sum(variables, joints)) < 0.1135 / 2 + 1e-9);
  }
}

}  // namespace
}  // namespace xr3
