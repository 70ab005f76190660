// Forward (direct) kinematics by the Denavit-Hartenberg convention (the paper's equations (2) and
// (3)), the tool-configuration vector and the net roll. Decisions use the tool tip in whole
// micrometres.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/coupling.hpp"
#include "core/model.hpp"

namespace xr3 {

using Transform = Eigen::Matrix4d;  ///< homogeneous, lengths in mm
using ToolConfiguration = Eigen::Matrix<double, 6, 1>;

/// The matrix of the paper's equation (2), for a row with these angles.
Transform row_transform(const SinCos& theta, const SinCos& alpha, double d_mm, double a_mm);

/// T(k-1,k) of joint `joint` (index k-1) at a position.
Transform link_transform(const Model& model, int joint, Counts position);

/// The transform from the base frame to frame 0: the robot's mount, or the identity.
Transform mount_transform(const Model& model);

/// T(0,k) for k = 0...n, the paper's equation (3), behind the mount; element 0 is the mount.
std::vector<Transform> base_transforms(const Model& model, const Positions& positions);

/// T(0,n) behind the mount: the tool's frame in the base frame. Its origin is the tip, z the
/// approach vector, y the sliding vector.
Transform tool_transform(const Model& model, const Positions& positions);

/// The tool tip in the base frame: bit-identical on every machine for the same counts.
PointUm tool_tip(const Model& model, const Positions& positions);

/// The displacement of the arm from its place at the soft home by its first joints, if they are
/// prismatic; horizontal, z is 0.
PointUm base_shift(const Model& model, const Positions& positions);

/// w = (p, exp(q_n / pi) * approach): mm, then dimensionless; q_n is the last joint's variable in
/// radians (mm for a prismatic one). For display only.
ToolConfiguration tool_configuration(const Model& model, const Positions& positions);
/// The vector of tool_configuration() for a tool frame T(0,n) and the last joint's variable, in
/// degrees or mm.
ToolConfiguration configuration_of(const Transform& pose, const Robot& robot, double last);

/// Yaw of the tool's x axis about the vertical with the tool down, in degrees (paper,
/// Section III-A).
double net_roll_deg(const Model& model, const Positions& positions);

/// Distance between the fingertips in mm at a tool position.
double opening_mm(const Model& model, Counts tool_position);

}  // namespace xr3
