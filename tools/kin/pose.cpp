#include "tools/kin/pose.hpp"

#include <algorithm>

#include "core/stall.hpp"

namespace xr3 {
namespace {

KinMotor motor_of(const Model& model, int index, double variable, const NearestCounts& counts) {
  const auto own = static_cast<std::size_t>(index);
  const MotorModel& motor = model.motor(index);
  const Counts position = counts.positions[own];
  return {variable, counts.motors[own], position, model.variable(index, position),
          motor.excess(position)};
}

}  // namespace

KinPose kin_pose(const Model& model, const DirectQuestion& question) {
  const Robot& robot = model.robot();
  const int tool = model.tool_index();
  NearestCounts counts = nearest_counts(model, question.variables);
  const Counts jaws = nearest_count(exact_position(robot.tool.drive, question.tool));
  counts.motors[static_cast<std::size_t>(tool)] = jaws;
  counts.positions[static_cast<std::size_t>(tool)] = jaws;

  KinPose pose;
  for (int k = 0; k < tool; ++k) {
    const double variable = question.variables[static_cast<std::size_t>(k)];
    pose.motors.push_back(motor_of(model, k, variable, counts));
    pose.links.push_back(link_transform_at(robot.joints[static_cast<std::size_t>(k)], variable));
  }
  pose.motors.push_back(motor_of(model, tool, question.tool, counts));
  pose.bases = base_transforms_at(robot, question.variables);
  pose.w = tool_configuration_at(robot, question.variables);
  pose.net_roll_deg = net_roll_deg_at(robot, question.variables);
  pose.opening_mm = opening_mm(model, jaws);
  pose.in_protected_region =
      is_in_protected_region(model, counts.positions, tool_tip(model, counts.positions));
  const ToolTarget exact =
      pose_target(pose.tool().block<3, 1>(0, 3), pose.tool().block<3, 3>(0, 0));
  pose.rounded = pose_error(robot, exact, variables_at(model, counts.positions));
  return pose;
}

}  // namespace xr3
