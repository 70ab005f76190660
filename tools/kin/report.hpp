// The output of `xr3 kin`, as text or as JSON: link matrices and the tool's pose for given joint
// variables (paper, equations (1) to (3)), or all solutions of the inverse kinematics with their
// motor counts. The question must be checked already; the caller prints.
//
// The flow through the folder: the command line fills KinOptionValues. kin_question()
// (question.hpp) checks them against the robot and makes a question for the direct or the inverse
// kinematics, or throws with what to give instead. For the direct one, pose.hpp computes the pose
// once: nearest motor counts with couplings removed, link matrices, tool configuration and the
// error of rounding; direct_text() and direct_json() print from it, so that both agree. For the
// inverse one, the caller runs solve_inverse() (core/inverse/inverse.hpp) and passes its result to
// inverse_text() or inverse_json(). text.hpp has the names of joints and units, and the sentences
// for refusals, freedoms and verdicts, each with a stable code for the JSON. report_json.cpp
// defines the functions for JSON.
#pragma once

#include <string>

#include "core/inverse/inverse.hpp"
#include "protocol/json/source.hpp"
#include "tools/kin/question.hpp"

namespace xr3 {

/// The pose as tables that end with a line feed: the tool, motors and limits, and T(k-1,k) and
/// T(0,k) of every link.
std::string direct_text(const Model& model, const DirectQuestion& question);
/// The pose as JSON in mm and degrees, with nine decimals. docs/kinematics.md describes the
/// members.
Json direct_json(const Model& model, const DirectQuestion& question);

/// Tables of motor counts and joint variables, one row per solution; or the reason why there is no
/// solution.
std::string inverse_text(const Model& model, const ToolTarget& target, const InverseResult& result);
Json inverse_json(const Model& model, const ToolTarget& target, const InverseResult& result);

/// Yaw, pitch and roll in degrees, R = Rz(yaw) Ry(pitch) Rx(roll). If pitch is +-90, yaw is 0.
Eigen::Vector3d yaw_pitch_roll_deg(const Eigen::Matrix3d& rotation);

}  // namespace xr3
