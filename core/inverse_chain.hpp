// The Denavit-Hartenberg chain at joint variables that need not lie on a count (paper, equations (2)
// and (3)), its Jacobian, and the whole motor counts nearest to such variables. For homework and
// planning: nothing here decides a count of the running machine.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/kinematics.hpp"
#include "core/model.hpp"

namespace xr3 {

/// One a joint, from the base: degrees (revolute) or mm (prismatic). |degrees| < 1e9.
using JointVariables = std::vector<double>;

/// T(k-1,k) of a joint at a value of its variable.
Transform link_transform_at(const Joint& joint, double variable);

/// T(0,k) for k = 0...count of variables, which may be fewer than the robot's joints.
std::vector<Transform> base_transforms_at(const Robot& robot, const JointVariables& variables);

/// T(0,n).
Transform tool_transform_at(const Robot& robot, const JointVariables& variables);

/// w as tool_configuration in kinematics.hpp has it.
ToolConfiguration tool_configuration_at(const Robot& robot, const JointVariables& variables);

/// The robot's signed sum of joint variables, in degrees.
double net_roll_deg_at(const Robot& robot, const JointVariables& variables);

/// Every joint at the soft home.
JointVariables home_variables(const Robot& robot);

/// The variables of joints that stand at these positions.
JointVariables variables_at(const Model& model, const Positions& positions);

/// What the motors would stand at, and where that puts the joints.
struct NearestCounts {
  Positions motors{};     ///< coupling taken out, then rounded: each motor is at its nearest count
  Positions positions{};  ///< the joints' positions that follow
};

/// A joint's own rounding would add up along a chain of couplings, so motors are rounded instead.
/// Motors past +-2e8 counts are held there.
NearestCounts nearest_counts(const Model& model, const JointVariables& variables);

/// Columns: velocity of the tip (mm) over angular velocity (rad), for each radian or mm of a joint.
Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian(const Robot& robot,
                                                  const std::vector<Transform>& base_transforms);

}  // namespace xr3
