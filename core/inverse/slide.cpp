#include "core/inverse/slide.hpp"

namespace xr3::inverse {

bool has_slide(const Robot& robot) { return !robot.joints.front().is_revolute(); }

bool is_carried(const Robot& robot) { return robot.mount || has_slide(robot); }

Robot carried_arm(const Robot& robot) {
  Robot arm;
  arm.joints.assign(robot.joints.begin() + (has_slide(robot) ? 1 : 0), robot.joints.end());
  return arm;
}

Transform carrier_pose(const Robot& robot, double slide_mm) {
  const JointVariables slide(has_slide(robot) ? 1 : 0, slide_mm);
  return base_transforms_at(robot, slide).back();
}

ToolTarget seen_from(const Transform& pose, const ToolTarget& target) {
  const Eigen::Matrix3d turn = pose.block<3, 3>(0, 0).transpose();
  ToolTarget seen = target;
  seen.p_mm = turn * (target.p_mm - pose.block<3, 1>(0, 3));
  seen.rotation = turn * target.rotation;
  return seen;
}

}  // namespace xr3::inverse
