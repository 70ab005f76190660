// Inverse kinematics: computes the joint variables and motor counts that bring the tool to a
// target, with a name for each solution. Closed form where the Denavit-Hartenberg rows allow one,
// numerical otherwise. Not in the paper, which leaves the inverse to the user's program (Section
// II). For tools and planning; the simulation does not use it.
//
// The flow through the folder: one of the functions *_target() makes a ToolTarget. solve_inverse()
// selects a method by the structure of the rows, inverse_method(): five_axis.cpp, scara.cpp and
// six_axis.cpp are closed forms, numerical.cpp handles all other arms. For an arm on a mount or a
// slide the target is first transformed to the arm's own base frame. The methods share solvers.hpp
// and return candidates: joint variables and branch names, or a refusal with its error. Each
// candidate is turned by full turns into the limits, rounded to motor counts with couplings removed
// (chain.hpp), checked against limits and protected region, and compared with the target again;
// duplicates are dropped, allowed solutions come first. reach.hpp asks the same solver whether a
// workcell's points can be reached.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/inverse/chain.hpp"
#include "core/kinematics.hpp"
#include "core/model.hpp"

namespace xr3 {

/// The part of the tool's frame that a target specifies.
enum class TargetKind : std::uint8_t {
  kPose,      ///< tip and rotation
  kPointing,  ///< tip, approach vector and the last joint's variable: a tool-configuration vector
  kTip,       ///< tip only, for robots with at most three joints
};

/// The wanted location of the tool in the base frame. Construct it with the functions below.
struct ToolTarget {
  TargetKind kind = TargetKind::kPose;
  Eigen::Vector3d p_mm = Eigen::Vector3d::Zero();
  /// Columns normal, sliding and approach in the base frame; kPointing uses only the last.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double last = 0;  ///< kPointing: degrees or mm

  Eigen::Vector3d approach() const { return rotation.col(2); }
};

/// A target with a rotation. Precondition: `rotation` is orthonormal and right-handed.
ToolTarget pose_target(const Eigen::Vector3d& p_mm, const Eigen::Matrix3d& rotation);
/// A target with a rotation by fixed axes: roll about x, then pitch about y, then yaw about z: R =
/// Rz(yaw) Ry(pitch) Rx(roll).
ToolTarget yaw_pitch_roll_target(const Eigen::Vector3d& p_mm, const Eigen::Vector3d& ypr_deg);
/// A target with the tool straight down, its x axis turned about the vertical by the net roll, as
/// for picking.
ToolTarget down_target(const Eigen::Vector3d& p_mm, double net_roll_deg);
/// A target with an approach vector. `approach` has any length except 0; `last` is the last joint's
/// variable.
ToolTarget pointing_target(const Eigen::Vector3d& p_mm, const Eigen::Vector3d& approach,
                           double last);
/// A target from a tool-configuration vector. The last joint's variable is pi * ln |(w4, w5, w6)|,
/// which must not be 0.
ToolTarget configuration_target(const Robot& robot, const ToolConfiguration& w);
ToolTarget tip_target(const Eigen::Vector3d& p_mm);

/// The method, which depends on the structure of the Denavit-Hartenberg rows.
enum class InverseMethod : std::uint8_t {
  kFiveAxisArm,  ///< vertical base, three parallel axes perpendicular to it, roll: closed form
  kScara,        ///< two vertical revolute axes, a vertical slide, roll: closed form
  kSixAxisArm,   ///< three shoulder axes through one point, elbow, wrist pitch, roll: closed form
  kNumerical,    ///< any other: damped least squares from many starts; may miss solutions
};
/// The method for the robot, or for its arm if that stands on a mount or a slide.
InverseMethod inverse_method(const Robot& robot);

/// Whether InverseOptions::slide_mm has an effect: joint 1 slides, and the arm on it has a closed
/// form.
bool keeps_slide(const Robot& robot);

/// The reason why there is no solution.
enum class InverseRefusal : std::uint8_t {
  kNo,
  kTooFar,               ///< the wrist is off_mm beyond the stretched arm's reach
  kTooNear,              ///< the wrist is off_mm inside the folded arm's reach
  kTooNearAxis,          ///< the tip is off_mm nearer to the base axis than the arm's offset
  kApproachOutOfPlane,   ///< the approach is off_deg out of the arm's vertical plane
  kApproachNotVertical,  ///< the approach is off_deg from the only direction the tool can have
  kNotFound,             ///< numerical: off_mm and off_deg are the errors of the best approximation
  kNeedsOrientation,     ///< the robot has too many joints for a target without orientation
};

/// Joints that the target leaves free. The solutions are then some of infinitely many.
enum class InverseFreedom : std::uint8_t {
  kBaseAndRoll,   ///< tip and hand on the base axis: base and roll are determined together only;
                  ///< the base is set to its home
  kFolded,        ///< wrist on the shoulder: the folded arm may swing; the shoulder is set to its
                  ///< home
  kArmPlane,      ///< hand, wrist and shoulder in line: the arm's plane may turn about that line;
                  ///< it is set vertical
  kShoulderAxes,  ///< arm's plane horizontal, base and shoulder pitch axes in line; the base is set
                  ///< to its home
  kSlide,         ///< the arm stands on a slide, which is kept at InverseOptions::slide_mm
  kMoreThanNeeded,  ///< numerical: the joints can move while the tool stays in place
};

struct InverseOptions {
  double tolerance_deg = 0.01;  ///< maximum error of the orientation
  double tolerance_mm = 1e-6;   ///< maximum error of the tip
  /// The place of the slide on which an arm with a closed form stands; default: its soft home.
  std::optional<double> slide_mm = std::nullopt;
  /// The variables from which the robot moves; default: the soft home. Full turns and the order of
  /// the solutions depend on them. If they are given, the numerical method starts only from them,
  /// which takes a hundredth of the time and finds at most one solution.
  std::optional<JointVariables> near = std::nullopt;
};

/// A joint past its limit.
struct LimitExcess {
  int joint = 0;      ///< index from 0 at the base
  Counts counts = 0;  ///< distance past the limit, above 0
  double amount = 0;  ///< distance past the limit in degrees or mm
};

struct PoseError {
  double mm = 0;  ///< distance of the tip
  /// kPose: angle of the rotation; kPointing: the larger of approach and last joint.
  double deg = 0;
};

struct InverseSolution {
  JointVariables variables;  ///< full turns chosen within the limits, then nearest to the start
  std::string branch;        ///< such as "front, elbow up"
  NearestCounts counts;
  std::vector<LimitExcess> beyond;   ///< joints past their limits at `counts`
  bool in_protected_region = false;  ///< whether the tip is in the protected region at `counts`
  PoseError exact;                   ///< error at `variables`
  PoseError rounded;                 ///< error at `counts`

  bool is_allowed() const { return beyond.empty() && !in_protected_region; }
};

struct InverseResult {
  InverseMethod method = InverseMethod::kNumerical;
  InverseRefusal refusal = InverseRefusal::kNo;
  double off_mm = 0;   ///< refusals only: error in mm
  double off_deg = 0;  ///< refusals only: error in degrees
  std::vector<InverseFreedom> freedoms;
  std::vector<InverseSolution>
      solutions;  ///< allowed ones first, then by the maximum travel of a motor from the start
};

/// All solutions of a closed form, or those that the numerical method finds. Deterministic: the
/// same input gives the same solutions in the same order.
InverseResult solve_inverse(const Model& model, const ToolTarget& target,
                            const InverseOptions& options = {});

/// The distance of the tool at these variables from the target.
PoseError pose_error(const Robot& robot, const ToolTarget& target, const JointVariables& variables);

}  // namespace xr3
