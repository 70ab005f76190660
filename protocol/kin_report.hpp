// What `xr3 kin` answers, as text for people or as JSON: link matrices and the tool for joint
// variables (paper, equations (1) to (3)), or every solution of the inverse kinematics with its motor
// counts. The caller has checked the question and prints.
#pragma once

#include <string>

#include "core/inverse.hpp"
#include "protocol/json_source.hpp"
#include "protocol/kin_question.hpp"

namespace xr3 {

/// Tables, ended by a line feed: motors and limits, T(k-1,k) and T(0,k) of every link, the tool.
std::string direct_text(const Model& model, const DirectQuestion& question);
/// The same in mm and degrees, to nine decimals. See docs/kinematics.md for its members.
Json direct_json(const Model& model, const DirectQuestion& question);

/// Tables of joint variables and motor counts, one row a solution; or the reason why there is none.
std::string inverse_text(const Model& model, const ToolTarget& target, const InverseResult& result);
Json inverse_json(const Model& model, const ToolTarget& target, const InverseResult& result);

/// Yaw, pitch and roll in degrees, R = Rz(yaw) Ry(pitch) Rx(roll); yaw is 0 where pitch is +-90.
Eigen::Vector3d yaw_pitch_roll_deg(const Eigen::Matrix3d& rotation);

}  // namespace xr3
