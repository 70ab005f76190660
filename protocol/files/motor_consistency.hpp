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

/// The drive of a joint, of the tool or of the carousel, with the data that the common rules need.
struct CheckedMotor {
  const Drive* drive;
  std::string pointer;      ///< of the joint, the tool or the carousel
  std::string home_member;  ///< `/theta_deg`, `/d`, `/home`, or `/limits` if there is none
  bool is_length;           ///< the variable is a length, not an angle
};

/// A number as the findings of the rules show it.
inline std::string number_text(double number) { return plain_number(number, 4); }

/// The joints from the base, then the tool, then the carousel. The elements point into `robot`.
std::vector<CheckedMotor> motors_of(const Robot& robot);

void check_motors(const Robot& robot, data::Reading& reading);

}  // namespace xr3
