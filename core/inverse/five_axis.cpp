// Five axes as in the Rhino: a vertical base axis, three parallel axes perpendicular to it that
// move the hand in one vertical plane, and roll. The tip alone determines the base angle, so an
// approach vector out of that plane is impossible. The rest is a two-link problem in the plane.
#include <cmath>

#include "core/inverse/solvers.hpp"

namespace xr3::inverse {
namespace {

constexpr double kOnAxisMm = 1e-7;
constexpr double kVertical = 1e-9;

/// Distance between the hand's plane and the base axis, along axis 1.
double offset_mm(const Robot& robot) {
  return row(robot, 2).d_mm + row(robot, 3).d_mm + row(robot, 4).d_mm;
}

// Axis 1 is s * (sin, -cos, 0) of the base angle, and dot(p, axis) = offset.
std::vector<double> base_angles(const Robot& robot, const ToolTarget& target, Candidates& found) {
  const Eigen::Vector3d& p = target.p_mm;
  const double rho = std::hypot(p.x(), p.y());
  const double offset = unit_sin(row(robot, 1).alpha_deg) * offset_mm(robot);
  if (rho > kOnAxisMm && rho >= std::abs(offset)) {
    const double bearing = std::atan2(p.y(), p.x());
    const double inner = std::asin(offset / rho);
    return {bearing + inner, bearing + kPi - inner};
  }
  if (std::abs(offset) > kOnAxisMm) {
    found.refuse(InverseRefusal::kTooNearAxis, std::abs(offset) - rho, 0);
    return {};
  }
  const Eigen::Vector3d z = target.approach();
  double bearing = std::atan2(z.y(), z.x());
  if (std::hypot(z.x(), z.y()) < kVertical) {
    found.set_free(InverseFreedom::kBaseAndRoll);
    bearing = to_rad(robot.joints[0].drive.home);
  }
  return {bearing, bearing + kPi};
}

/// In frame 1: the hand's slope, theta2 + theta3 + theta4, and the wrist, where axis 4 crosses the
/// plane.
struct Hand {
  double slope_rad;
  Eigen::Vector2d wrist;
};

Hand hand_in_plane(const Robot& robot, const Eigen::Vector3d& p, const Eigen::Vector3d& approach) {
  const double s = unit_sin(row(robot, 4).alpha_deg);
  const double slope = std::atan2(s * approach.x(), -s * approach.y());
  const Eigen::Vector2d along(std::cos(slope), std::sin(slope));
  const Eigen::Vector2d pointing(s * along.y(), -s * along.x());
  return {slope, p.head<2>() - row(robot, 5).d_mm * pointing - row(robot, 4).a_mm * along};
}

void solve_at(double base_rad, const Robot& robot, const ToolTarget& target,
              const InverseOptions& options, Candidates& found) {
  const JointVariables base{to_deg(base_rad)};
  const Transform frame = base_transforms_at(robot, base).back();
  const Eigen::Matrix3d rotation = frame.block<3, 3>(0, 0);
  const Eigen::Vector3d p = rotation.transpose() * (target.p_mm - frame.block<3, 1>(0, 3));
  const Eigen::Vector3d approach = rotation.transpose() * target.approach();
  const double lean_deg = to_deg(std::asin(std::min(std::abs(approach.z()), 1.0)));
  if (lean_deg > options.tolerance_deg) {
    found.refuse(InverseRefusal::kApproachOutOfPlane, 0, lean_deg);
    return;
  }
  const Hand hand = hand_in_plane(robot, p, approach);
  const TwoLinks links{row(robot, 2).a_mm, row(robot, 3).a_mm, to_rad(robot.joints[1].drive.home)};
  const double ahead = rotation.col(0).dot(target.p_mm);
  for (const TwoLinkPosture& at :
       two_link_postures(links, hand.wrist, options.tolerance_mm, found)) {
    const double pitch = hand.slope_rad - at.first_rad - at.second_rad;
    JointVariables variables{base[0], to_deg(at.first_rad), to_deg(at.second_rad), to_deg(pitch)};
    const Eigen::Vector3d wrist = rotation * Eigen::Vector3d(hand.wrist.x(), hand.wrist.y(), 0);
    add_last(robot, target, variables);
    found.list.push_back({std::move(variables), std::string(ahead > -kOnAxisMm ? "front" : "back") +
                                                    ", " + elbow_name(rotation, links, at, wrist)});
  }
}

}  // namespace

bool is_five_axis_arm(const Robot& robot) {
  if (robot.joints.size() != 5 || !all_turn(robot) || !ends_in_plain_roll(robot)) return false;
  return is_quarter(row(robot, 1).alpha_deg) && is_angle(row(robot, 2).alpha_deg, 0) &&
         is_angle(row(robot, 3).alpha_deg, 0) && is_quarter(row(robot, 4).alpha_deg) &&
         !is_zero(row(robot, 2).a_mm) && !is_zero(row(robot, 3).a_mm);
}

Candidates solve_five_axis_arm(const Robot& robot, const ToolTarget& target,
                               const InverseOptions& options) {
  Candidates found;
  for (const double base : base_angles(robot, target, found)) {
    solve_at(base, robot, target, options, found);
  }
  return found;
}

}  // namespace xr3::inverse
