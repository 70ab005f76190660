#include "core/inverse/inverse.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "core/inverse/solvers.hpp"
#include "core/stall.hpp"

namespace xr3 {
namespace {

constexpr double kTurnDeg = 360.0;
constexpr double kSameSolution = 1e-6;  // degrees or mm, of every joint
constexpr int kMaxJointsForTip = 3;

using inverse::Candidate;
using inverse::Candidates;

// An arm that stands on a mount or on a slide has the closed form of the bare arm, in that one's
// base frame, once the place of the slide is chosen.

bool has_slide(const Robot& robot) { return !robot.joints.front().is_revolute(); }

/// Whether there is a mount or a slide below the arm.
bool is_carried(const Robot& robot) { return robot.mount || has_slide(robot); }

/// The joints behind mount and slide, without outlines, couplings and tool. Only for their
/// Denavit-Hartenberg rows and homes.
Robot carried_arm(const Robot& robot) {
  Robot arm;
  arm.joints.assign(robot.joints.begin() + (has_slide(robot) ? 1 : 0), robot.joints.end());
  return arm;
}

/// From the base frame to frame 0 of carried_arm(). `slide_mm` is ignored without a slide.
Transform carrier_pose(const Robot& robot, double slide_mm) {
  const JointVariables slide(has_slide(robot) ? 1 : 0, slide_mm);
  return base_transforms_at(robot, slide).back();
}

/// The target in the frame with this pose.
ToolTarget seen_from(const Transform& pose, const ToolTarget& target) {
  const Eigen::Matrix3d turn = pose.block<3, 3>(0, 0).transpose();
  ToolTarget seen = target;
  seen.p_mm = turn * (target.p_mm - pose.block<3, 1>(0, 3));
  seen.rotation = turn * target.rotation;
  return seen;
}

Eigen::Vector3d tip_of(const Transform& pose) { return pose.block<3, 1>(0, 3); }

/// The minimum and maximum value that still round to a count within the limits.
struct ValueRange {
  double low;
  double high;

  double excess(double value) const { return std::max({low - value, value - high, 0.0}); }
};

ValueRange allowed_span(const Model& model, int joint) {
  const MotorModel& motor = model.motor(joint);
  const auto [low, high] =
      std::minmax({model.variable(joint, motor.low), model.variable(joint, motor.high)});
  return {low - motor.drive.precision / 2, high + motor.drive.precision / 2};
}

/// Adds full turns so that the value is within the limits if possible, and then nearest to the
/// start.
double wrapped(const Model& model, int joint, double angle_deg, double start_deg) {
  const ValueRange span = allowed_span(model, joint);
  const double near = start_deg + std::remainder(angle_deg - start_deg, kTurnDeg);
  double best = near;
  for (const double other : {near + kTurnDeg, near - kTurnDeg}) {
    if (span.excess(other) < span.excess(best)) best = other;
  }
  return best;
}

void wrap(const Model& model, const ToolTarget& target, const JointVariables& start,
          JointVariables& variables) {
  const bool keeps_last = target.kind == TargetKind::kPointing;
  for (int k = 0; k < model.joint_count(); ++k) {
    const auto own = static_cast<std::size_t>(k);
    const bool is_last = k + 1 == model.joint_count();
    if (!model.robot().joints[own].is_revolute() || (is_last && keeps_last)) continue;
    variables[own] = wrapped(model, k, variables[own], start[own]);
  }
}

std::vector<LimitExcess> limits_passed(const Model& model, const Positions& positions) {
  std::vector<LimitExcess> beyond;
  for (int k = 0; k < model.joint_count(); ++k) {
    const MotorModel& motor = model.motor(k);
    const Counts counts = motor.excess(positions[static_cast<std::size_t>(k)]);
    if (counts > 0) beyond.push_back({k, counts, counts * motor.drive.precision});
  }
  return beyond;
}

InverseSolution solution_of(const Model& model, const ToolTarget& target,
                            const JointVariables& start, Candidate candidate) {
  InverseSolution solution;
  solution.variables = std::move(candidate.variables);
  solution.branch = std::move(candidate.branch);
  wrap(model, target, start, solution.variables);
  solution.counts = nearest_counts(model, solution.variables);
  const Positions& positions = solution.counts.positions;
  solution.beyond = limits_passed(model, positions);
  solution.in_protected_region =
      is_in_protected_region(model, positions, tool_tip(model, positions));
  solution.exact = pose_error(model.robot(), target, solution.variables);
  solution.rounded = pose_error(model.robot(), target, variables_at(model, positions));
  return solution;
}

bool is_same(const JointVariables& one, const JointVariables& other) {
  for (std::size_t k = 0; k < one.size(); ++k) {
    if (std::abs(one[k] - other[k]) > kSameSolution) return false;
  }
  return true;
}

void add_new(std::vector<InverseSolution>& solutions, InverseSolution solution) {
  for (const InverseSolution& known : solutions) {
    if (is_same(known.variables, solution.variables)) return;
  }
  solutions.push_back(std::move(solution));
}

Counts longest_travel(const InverseSolution& solution, const Positions& start) {
  Counts longest = 0;
  for (std::size_t i = 0; i < start.size(); ++i)
    longest = std::max(longest, std::abs(solution.counts.motors[i] - start[i]));
  return longest;
}

/// `start` are motor counts.
void sort_solutions(std::vector<InverseSolution>& solutions, const Positions& start) {
  const auto key = [&start](const InverseSolution& solution) {
    return std::tuple(!solution.is_allowed(), longest_travel(solution, start));
  };
  std::stable_sort(solutions.begin(), solutions.end(),
                   [&](const auto& one, const auto& other) { return key(one) < key(other); });
}

/// Precondition: the method is a closed form of this arm, which has neither mount nor slide.
Candidates solve_arm(const Robot& arm, InverseMethod method, const ToolTarget& target,
                     const InverseOptions& options) {
  if (method == InverseMethod::kFiveAxisArm)
    return inverse::solve_five_axis_arm(arm, target, options);
  if (method == InverseMethod::kScara) return inverse::solve_scara(arm, target, options);
  assert(method == InverseMethod::kSixAxisArm);
  return inverse::solve_six_axis_arm(arm, target, options);
}

Candidates find_candidates(const Robot& robot, InverseMethod method, const ToolTarget& target,
                           const InverseOptions& options) {
  Candidates found;
  if (target.kind == TargetKind::kTip && robot.joints.size() > kMaxJointsForTip) {
    found.refuse(InverseRefusal::kNeedsOrientation, 0, 0);
    return found;
  }
  if (method == InverseMethod::kNumerical)
    return inverse::solve_numerically(robot, target, options);
  if (!is_carried(robot)) return solve_arm(robot, method, target, options);
  const double slide_mm = options.slide_mm.value_or(robot.joints.front().drive.home);
  const Transform carrier = carrier_pose(robot, slide_mm);
  found = solve_arm(carried_arm(robot), method, seen_from(carrier, target), options);
  if (!has_slide(robot)) return found;
  found.set_free(InverseFreedom::kSlide);
  for (Candidate& candidate : found.list)
    candidate.variables.insert(candidate.variables.begin(), slide_mm);
  return found;
}

InverseMethod method_of_arm(const Robot& arm) {
  if (arm.joints.empty()) return InverseMethod::kNumerical;
  if (inverse::is_five_axis_arm(arm)) return InverseMethod::kFiveAxisArm;
  if (inverse::is_scara(arm)) return InverseMethod::kScara;
  if (inverse::is_six_axis_arm(arm)) return InverseMethod::kSixAxisArm;
  return InverseMethod::kNumerical;
}

double angle_between_deg(const Eigen::Vector3d& one, const Eigen::Vector3d& other) {
  return inverse::to_deg(std::atan2(one.cross(other).norm(), one.dot(other)));
}

}  // namespace

ToolTarget pose_target(const Eigen::Vector3d& p_mm, const Eigen::Matrix3d& rotation) {
  assert(rotation.isUnitary(1e-6) && rotation.determinant() > 0);
  return {TargetKind::kPose, p_mm, rotation, 0};
}

ToolTarget yaw_pitch_roll_target(const Eigen::Vector3d& p_mm, const Eigen::Vector3d& ypr_deg) {
  const SinCos yaw = sin_cos_deg(ypr_deg.x());
  const SinCos pitch = sin_cos_deg(ypr_deg.y());
  const SinCos roll = sin_cos_deg(ypr_deg.z());
  Eigen::Matrix3d about_z;
  Eigen::Matrix3d about_y;
  Eigen::Matrix3d about_x;
  about_z << yaw.cos, -yaw.sin, 0, yaw.sin, yaw.cos, 0, 0, 0, 1;
  about_y << pitch.cos, 0, pitch.sin, 0, 1, 0, -pitch.sin, 0, pitch.cos;
  about_x << 1, 0, 0, 0, roll.cos, -roll.sin, 0, roll.sin, roll.cos;
  return pose_target(p_mm, about_z * about_y * about_x);
}

ToolTarget down_target(const Eigen::Vector3d& p_mm, double net_roll_deg) {
  return yaw_pitch_roll_target(p_mm, {net_roll_deg, 0, 180});
}

ToolTarget pointing_target(const Eigen::Vector3d& p_mm, const Eigen::Vector3d& approach,
                           double last) {
  ToolTarget target{TargetKind::kPointing, p_mm, Eigen::Matrix3d::Zero(), last};
  target.rotation.col(2) = approach.normalized();
  return target;
}

ToolTarget configuration_target(const Robot& robot, const ToolConfiguration& w) {
  const double q = kPi * std::log(w.tail<3>().norm());
  const double last = robot.joints.back().is_revolute() ? inverse::to_deg(q) : q;
  return pointing_target(w.head<3>(), w.tail<3>(), last);
}

ToolTarget tip_target(const Eigen::Vector3d& p_mm) {
  return {TargetKind::kTip, p_mm, Eigen::Matrix3d::Identity(), 0};
}

InverseMethod inverse_method(const Robot& robot) {
  return is_carried(robot) ? method_of_arm(carried_arm(robot)) : method_of_arm(robot);
}

bool keeps_slide(const Robot& robot) {
  return has_slide(robot) && inverse_method(robot) != InverseMethod::kNumerical;
}

InverseResult solve_inverse(const Model& model, const ToolTarget& target,
                            const InverseOptions& options) {
  InverseResult result;
  result.method = inverse_method(model.robot());
  Candidates found = find_candidates(model.robot(), result.method, target, options);
  result.freedoms = std::move(found.freedoms);
  const JointVariables start = options.near.value_or(home_variables(model.robot()));
  for (Candidate& candidate : found.list) {
    add_new(result.solutions, solution_of(model, target, start, std::move(candidate)));
  }
  sort_solutions(result.solutions, nearest_counts(model, start).motors);
  if (!result.solutions.empty()) return result;
  result.refusal = found.refusal;
  result.off_mm = found.off_mm;
  result.off_deg = found.off_deg;
  return result;
}

PoseError pose_error(const Robot& robot, const ToolTarget& target,
                     const JointVariables& variables) {
  const Transform pose = tool_transform_at(robot, variables);
  const Eigen::Matrix3d rotation = pose.block<3, 3>(0, 0);
  PoseError error;
  error.mm = (tip_of(pose) - target.p_mm).norm();
  if (target.kind == TargetKind::kPointing) {
    const double last =
        robot.joints.back().is_revolute() ? std::abs(variables.back() - target.last) : 0;
    error.deg = std::max(angle_between_deg(rotation.col(2), target.approach()), last);
  } else if (target.kind == TargetKind::kPose) {
    const Eigen::Quaterniond turn(rotation.transpose() * target.rotation);
    error.deg = 2 * inverse::to_deg(std::atan2(turn.vec().norm(), std::abs(turn.w())));
  }
  return error;
}

}  // namespace xr3
