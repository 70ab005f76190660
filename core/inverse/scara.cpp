// Four axes as in the Adept One: two vertical revolute axes, a vertical slide, and roll. Seen from
// above this is a two-link problem in a plane; the slide alone determines the height. The tool can
// point in one direction only.
#include <cmath>

#include "core/inverse/solvers.hpp"

namespace xr3::inverse {
namespace {

bool is_upright(double twist_deg) { return is_angle(twist_deg, 0) || is_angle(twist_deg, 180); }

/// Directions of axes 1, 2 and 3: +1 up, -1 down.
struct Ways {
  double after_first;
  double after_second;
  double tool;
};

Ways ways(const Robot& robot) {
  const double first = unit_cos(row(robot, 1).alpha_deg);
  const double second = first * unit_cos(row(robot, 2).alpha_deg);
  return {first, second, second * unit_cos(row(robot, 3).alpha_deg)};
}

double slide_mm(const Robot& robot, const Ways& way, double z_mm) {
  const double fixed =
      row(robot, 1).d_mm + way.after_first * row(robot, 2).d_mm + way.tool * row(robot, 4).d_mm;
  return way.after_second * (z_mm - fixed);
}

double lean_deg(const Eigen::Vector3d& approach, double way) {
  return to_deg(std::atan2(std::hypot(approach.x(), approach.y()), way * approach.z()));
}

}  // namespace

bool is_scara(const Robot& robot) {
  if (robot.joints.size() != 4 || !ends_in_plain_roll(robot)) return false;
  for (std::size_t k = 0; k < 4; ++k) {
    const bool slides = robot.joints[k].variable == JointVariable::kD;
    if (slides != (k == 2)) return false;
  }
  return is_upright(row(robot, 1).alpha_deg) && is_upright(row(robot, 2).alpha_deg) &&
         is_upright(row(robot, 3).alpha_deg) && is_zero(row(robot, 3).a_mm) &&
         !is_zero(row(robot, 1).a_mm) && !is_zero(row(robot, 2).a_mm);
}

Candidates solve_scara(const Robot& robot, const ToolTarget& target,
                       const InverseOptions& options) {
  Candidates found;
  const Ways way = ways(robot);
  const double lean = lean_deg(target.approach(), way.tool);
  if (lean > options.tolerance_deg) {
    found.refuse(InverseRefusal::kApproachNotVertical, 0, lean);
    return found;
  }
  const TwoLinks links{row(robot, 1).a_mm, row(robot, 2).a_mm, to_rad(robot.joints[0].drive.home)};
  const Eigen::Vector2d wrist = target.p_mm.head<2>();
  for (const TwoLinkPosture& at : two_link_postures(links, wrist, options.tolerance_mm, found)) {
    JointVariables variables{to_deg(at.first_rad), way.after_first * to_deg(at.second_rad),
                             slide_mm(robot, way, target.p_mm.z())};
    add_last(robot, target, variables);
    found.list.push_back({std::move(variables), elbow_name(Eigen::Matrix3d::Identity(), links, at,
                                                           {wrist.x(), wrist.y(), 0})});
  }
  return found;
}

}  // namespace xr3::inverse
