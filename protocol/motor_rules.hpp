// What one field of a motor cannot say alone, the same for joints and tool: the label's place in the
// sequence, limits about the home, a mask that no other switch has, a switch position that means something.
#pragma once

#include <string>
#include <vector>

#include "core/robot.hpp"
#include "protocol/data_json.hpp"

namespace xr3 {

/// Most counts that the limits may lie from the soft home, so that sums of counts never overflow.
inline constexpr double kMaxCountsFromHome = 1e8;

/// A joint's drive or the tool's, with what the rules for both need to know.
struct CheckedMotor {
  const Drive* drive;
  std::string pointer;      ///< of the joint or the tool
  std::string home_member;  ///< `/theta_deg`, `/d` or `/home`
  char label;               ///< the one that the sequence gives it
  bool is_length;           ///< the variable is a length, not an angle
};

/// The joints from the base, then the tool; they point into the robot.
std::vector<CheckedMotor> motors_of(const Robot& robot);

void check_motors(const Robot& robot, data::Reading& reading);

}  // namespace xr3
