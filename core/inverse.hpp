// Inverse kinematics: from where the tool is to be to the joint variables and motor counts that bring
// it there, every solution named. Closed form where the Denavit-Hartenberg rows allow one, by numbers
// elsewhere. It goes beyond the paper, which leaves the inverse to the user's program (Section II).
// For desks and planners: the running machine never asks it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/inverse_chain.hpp"
#include "core/kinematics.hpp"
#include "core/model.hpp"

namespace xr3 {

/// How much of the tool's frame a target fixes.
enum class TargetKind : std::uint8_t {
  kPose,      ///< tip and rotation
  kPointing,  ///< tip, approach vector and the last joint's variable: a tool-configuration vector
  kTip,       ///< tip only, for robots of at most three joints
};

/// Where the tool is to be, in the base frame. Make one with the functions below.
struct ToolTarget {
  TargetKind kind = TargetKind::kPose;
  Eigen::Vector3d p_mm = Eigen::Vector3d::Zero();
  /// Columns normal, sliding and approach in the base frame; of a kPointing only the last counts.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double last = 0;  ///< kPointing: degrees or mm

  Eigen::Vector3d approach() const { return rotation.col(2); }
};

/// `rotation` is orthonormal and right-handed.
ToolTarget pose_target(const Eigen::Vector3d& p_mm, const Eigen::Matrix3d& rotation);
/// Fixed axes: roll about x, then pitch about y, then yaw about z: R = Rz(yaw) Ry(pitch) Rx(roll).
ToolTarget yaw_pitch_roll_target(const Eigen::Vector3d& p_mm, const Eigen::Vector3d& ypr_deg);
/// Tool straight down, its x axis turned about the vertical by the net roll: for picking.
ToolTarget down_target(const Eigen::Vector3d& p_mm, double net_roll_deg);
/// `approach` of any length but 0; `last` is the last joint's variable, kept as it is.
ToolTarget pointing_target(const Eigen::Vector3d& p_mm, const Eigen::Vector3d& approach,
                           double last);
/// The last joint's variable is pi * ln of the length of (w4, w5, w6), which may not be 0.
ToolTarget configuration_target(const Robot& robot, const ToolConfiguration& w);
ToolTarget tip_target(const Eigen::Vector3d& p_mm);

/// How the solutions were found, by the structure of the Denavit-Hartenberg rows.
enum class InverseMethod : std::uint8_t {
  kFiveAxisArm,  ///< upright base, three parallel axes across it, roll: closed form
  kScara,        ///< two upright turning axes, an upright slide, roll: closed form
  kSixAxisArm,   ///< three shoulder axes through one point, elbow, wrist pitch, roll: closed form
  kNumerical,    ///< any other: damped least squares from many starts; it may miss solutions
};
InverseMethod inverse_method(const Robot& robot);

/// Why there is no solution.
enum class InverseRefusal : std::uint8_t {
  kNo,
  kTooFar,       ///< the wrist would be off_mm beyond the stretched arm
  kTooNear,      ///< the wrist would be off_mm inside what the folded arm reaches
  kTooNearAxis,  ///< the tip would be off_mm nearer to the base axis than the arm's own offset
  kApproachOutOfPlane,   ///< the approach leans off_deg out of the arm's upright plane
  kApproachNotVertical,  ///< the approach leans off_deg from the only way the tool can point
  kNotFound,             ///< numerical: off_mm and off_deg are those of the nearest that was found
  kNeedsOrientation,     ///< a tip alone leaves this robot too free
};

/// Joints that the target leaves free: the solutions are some of infinitely many.
enum class InverseFreedom : std::uint8_t {
  kBaseAndRoll,   ///< tip and hand on the base axis: base against roll; base taken at its home
  kFolded,        ///< wrist on the shoulder: the folded arm may swing; shoulder taken at its home
  kArmPlane,      ///< hand in line with the wrist and shoulder: the arm's plane may turn about it;
                  ///< taken upright
  kShoulderAxes,  ///< arm's plane level, base and shoulder pitch in line; base taken at its home
  kMoreThanNeeded,  ///< numerical: joints can move with the tool standing still
};

struct InverseOptions {
  double tolerance_deg = 0.01;  ///< how far the approach of an arm with few joints may be off
  double tolerance_mm = 1e-6;   ///< how far the tip may be off
};

/// A joint past its limit.
struct LimitExcess {
  int joint = 0;      ///< index from 0 at the base
  Counts counts = 0;  ///< how many past it, above 0
  double amount = 0;  ///< the same in degrees or mm
};

struct PoseError {
  double mm = 0;   ///< of the tip
  double deg = 0;  ///< kPose: of the rotation; kPointing: the greater of approach and last joint
};

struct InverseSolution {
  JointVariables variables;  ///< a full turn apart: that within the limits nearest to the soft home
  std::string branch;        ///< as "front, elbow up"
  NearestCounts counts;
  std::vector<LimitExcess> beyond;   ///< joints that the limits forbid, at those counts
  bool in_protected_region = false;  ///< the tip, at those counts
  PoseError exact;                   ///< of the variables against the target
  PoseError rounded;                 ///< of the counts against the target

  bool is_allowed() const { return beyond.empty() && !in_protected_region; }
};

struct InverseResult {
  InverseMethod method = InverseMethod::kNumerical;
  InverseRefusal refusal = InverseRefusal::kNo;
  double off_mm = 0;   ///< of a refusal
  double off_deg = 0;  ///< of a refusal
  std::vector<InverseFreedom> freedoms;
  std::vector<InverseSolution>
      solutions;  ///< allowed ones first, then by the longest motor's travel
};

/// All solutions of a closed form, or those that the numerical way finds. The same input gives the
/// same solutions in the same order.
InverseResult solve_inverse(const Model& model, const ToolTarget& target,
                            const InverseOptions& options = {});

/// How far the tool at these variables is from the target.
PoseError pose_error(const Robot& robot, const ToolTarget& target, const JointVariables& variables);

}  // namespace xr3
