// Six axes as in the Intelledex 660: base, shoulder roll and shoulder pitch meet at right angles in
// one point S; upper arm and forearm turn about axes parallel to the shoulder pitch; wrist pitch
// and roll meet in W. W follows from tip and approach. Axis 2, the normal of the arm's plane, is
// perpendicular to S-W and to the approach. That leaves two signs of the normal, for each two pairs
// of base and shoulder roll, and for each pair two postures of two links in a plane: eight
// solutions.
#include <Eigen/Geometry>
#include <cmath>

#include "core/inverse/solvers.hpp"

namespace xr3::inverse {
namespace {

constexpr double kInLine = 1e-9;  // sine of an angle below which two directions count as equal
constexpr double kOnShoulderMm = 1e-9;

/// The target in terms of this arm: the vector from S to W, and the approach.
struct Aim {
  Eigen::Vector3d wrist;
  Eigen::Vector3d approach;
};

Aim aim_at(const Robot& robot, const ToolTarget& target) {
  const Eigen::Vector3d shoulder(0, 0, row(robot, 1).d_mm);
  const Eigen::Vector3d approach = target.approach();
  return {target.p_mm - row(robot, 6).d_mm * approach - shoulder, approach};
}

/// The normal of the arm's plane, up to its sign. The last step makes the normal perpendicular to
/// the wrist again, so that the wrist is exact even near the singular line.
Eigen::Vector3d plane_normal(const Robot& robot, const Aim& aim, Candidates& found) {
  const bool on_shoulder = aim.wrist.norm() < kOnShoulderMm;
  const Eigen::Vector3d line = on_shoulder ? aim.approach : aim.wrist.normalized();
  Eigen::Vector3d normal = line.cross(aim.approach);
  if (normal.norm() < kInLine) {
    found.set_free(InverseFreedom::kArmPlane);
    normal = Eigen::Vector3d::UnitZ().cross(line);
  }
  if (normal.norm() < kInLine) {
    const SinCos home = sin_cos_deg(robot.joints[0].drive.home);
    normal = Eigen::Vector3d(home.cos, home.sin, 0);
  }
  normal.normalize();
  return (normal - line * normal.dot(line)).normalized();
}

/// The base and shoulder roll angles for which axis 2 has this direction. Axis 2 is
/// s2 * (sin2 * cos1, sin2 * sin1, -s1 * cos2), where s1 and s2 are the sines of the twists.
std::vector<JointVariables> shoulders(const Robot& robot, const Eigen::Vector3d& axis,
                                      Candidates& found) {
  const double s1 = unit_sin(row(robot, 1).alpha_deg);
  const double s2 = unit_sin(row(robot, 2).alpha_deg);
  const double level = std::hypot(axis.x(), axis.y());
  const double cosine = -s1 * s2 * axis.z();
  if (level < kInLine) {
    found.set_free(InverseFreedom::kShoulderAxes);
    return {{robot.joints[0].drive.home, cosine > 0 ? 0.0 : 180.0}};
  }
  std::vector<JointVariables> pairs;
  for (const double sine : {level, -level}) {
    const double base = std::atan2(s2 * axis.y() / sine, s2 * axis.x() / sine);
    pairs.push_back({to_deg(base), to_deg(std::atan2(sine, cosine))});
  }
  return pairs;
}

std::string shoulder_name(const Robot& robot, const JointVariables& shoulder,
                          const Eigen::Vector3d& wrist) {
  const SinCos base = sin_cos_deg(shoulder[0]);
  const Eigen::Vector2d ahead =
      unit_sin(row(robot, 1).alpha_deg) * Eigen::Vector2d(base.sin, -base.cos);
  const std::string facing = ahead.dot(wrist.head<2>()) > -kOnShoulderMm ? "front" : "back";
  const double roll = sin_cos_deg(shoulder[1]).sin;
  if (std::abs(roll) < kInLine) return facing + ", roll level";
  return facing + (roll > 0 ? ", roll +" : ", roll -");
}

void solve_at(const JointVariables& shoulder, const Robot& robot, const ToolTarget& target,
              const InverseOptions& options, Candidates& found) {
  const Aim aim = aim_at(robot, target);
  const Eigen::Matrix3d rotation = base_transforms_at(robot, shoulder).back().block<3, 3>(0, 0);
  const Eigen::Vector3d wrist = rotation.transpose() * aim.wrist;
  const Eigen::Vector3d approach = rotation.transpose() * aim.approach;
  const double s = unit_sin(row(robot, 5).alpha_deg);
  const double slope = std::atan2(s * approach.x(), -s * approach.y());
  const TwoLinks links{row(robot, 3).a_mm, row(robot, 4).a_mm, to_rad(robot.joints[2].drive.home)};
  for (const TwoLinkPosture& at :
       two_link_postures(links, wrist.head<2>(), options.tolerance_mm, found)) {
    JointVariables variables = shoulder;
    variables.push_back(to_deg(at.first_rad));
    variables.push_back(to_deg(at.second_rad));
    variables.push_back(to_deg(slope - at.first_rad - at.second_rad));
    add_last(robot, target, variables);
    found.list.push_back({std::move(variables), shoulder_name(robot, shoulder, aim.wrist) + ", " +
                                                    elbow_name(rotation, links, at, aim.wrist)});
  }
}

}  // namespace

bool is_six_axis_arm(const Robot& robot) {
  if (robot.joints.size() != 6 || !all_turn(robot) || !ends_in_plain_roll(robot)) return false;
  const bool meets = is_zero(row(robot, 1).a_mm) && is_zero(row(robot, 2).a_mm) &&
                     is_zero(row(robot, 2).d_mm) && is_zero(row(robot, 5).a_mm) &&
                     is_zero(row(robot, 3).d_mm + row(robot, 4).d_mm + row(robot, 5).d_mm);
  const bool twists = is_quarter(row(robot, 1).alpha_deg) && is_quarter(row(robot, 2).alpha_deg) &&
                      is_angle(row(robot, 3).alpha_deg, 0) &&
                      is_angle(row(robot, 4).alpha_deg, 0) && is_quarter(row(robot, 5).alpha_deg);
  return meets && twists && !is_zero(row(robot, 3).a_mm) && !is_zero(row(robot, 4).a_mm);
}

Candidates solve_six_axis_arm(const Robot& robot, const ToolTarget& target,
                              const InverseOptions& options) {
  Candidates found;
  const Eigen::Vector3d normal = plane_normal(robot, aim_at(robot, target), found);
  for (const double sign : {1.0, -1.0}) {
    for (const JointVariables& shoulder : shoulders(robot, sign * normal, found)) {
      solve_at(shoulder, robot, target, options, found);
    }
  }
  return found;
}

}  // namespace xr3::inverse
