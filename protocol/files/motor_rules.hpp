// The rules for motors, of joints and tool alike, that concern more than one field: distinct
// labels, limits around the home, distinct masks, and a usable switch position.
#pragma once

#include <string>
#include <vector>

#include "core/robot.hpp"
#include "protocol/json/codec.hpp"
#include "protocol/text/table.hpp"

namespace xr3 {

/// Maximum distance of the limits from the soft home, in counts, so that sums of counts never
/// overflow.
inline constexpr double kMaxCountsFromHome = 1e8;

/// The drive of a joint or of the tool, with the data that the common rules need.
struct CheckedMotor {
  const Drive* drive;
  std::string pointer;      ///< of the joint or the tool
  std::string home_member;  ///< `/theta_deg`, `/d` or `/home`
  bool is_length;           ///< the variable is a length, not an angle
};

/// A number as the findings of the rules show it.
inline std::string number_text(double number) { return plain_number(number, 4); }

/// The joints from the base, then the tool. The elements point into `robot`.
std::vector<CheckedMotor> motors_of(const Robot& robot);

void check_motors(const Robot& robot, data::Reading& reading);

}  // namespace xr3
