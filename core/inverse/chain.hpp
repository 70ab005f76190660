// The Denavit-Hartenberg chain (paper, equations (2) and (3)) at joint variables that need not lie
// on a count, its Jacobian, and the motor counts nearest to such variables. For tools and planning;
// the simulation does not use it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/kinematics.hpp"
#include "core/model.hpp"

namespace xr3 {

/// One variable per joint, from the base: degrees (revolute) or mm (prismatic). |degrees| < 1e9.
using JointVariables = std::vector<double>;

/// The position of a joint or the tool at a variable, in counts and fractions.
double exact_position(const Drive& drive, double variable);

/// The nearest count, clamped to +-2e8.
Counts nearest_count(double counts);

/// T(k-1,k) of a joint.
Transform link_transform_at(const Joint& joint, double variable);

/// T(0,k) for k = 0...variables.size(), which may be less than the number of joints, behind the
/// mount.
std::vector<Transform> base_transforms_at(const Robot& robot, const JointVariables& variables);

/// T(0,n) behind the mount.
Transform tool_transform_at(const Robot& robot, const JointVariables& variables);

/// The vector w of tool_configuration() in kinematics.hpp.
ToolConfiguration tool_configuration_at(const Robot& robot, const JointVariables& variables);

/// The net roll in degrees.
double net_roll_deg_at(const Robot& robot, const JointVariables& variables);

/// The variables at the soft home.
JointVariables home_variables(const Robot& robot);

/// The variables at these positions.
JointVariables variables_at(const Model& model, const Positions& positions);

/// Motor counts and the joint positions that they give.
struct NearestCounts {
  Positions motors{};     ///< after removal of coupling, each rounded to its nearest count
  Positions positions{};  ///< the resulting joint positions
};

/// Rounds the motors, not the joints: rounded joints would add up errors along a chain of
/// couplings. Motor counts are clamped to +-2e8.
NearestCounts nearest_counts(const Model& model, const JointVariables& variables);

/// One column per joint: velocity of the tip (mm) above angular velocity (rad), per radian or mm of
/// the joint.
Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian(const Robot& robot,
                                                  const std::vector<Transform>& base_transforms);

}  // namespace xr3
