// What one field of a robot file cannot say alone: labels in sequence, masks that do not clash, homes
// and switches within limits, references to joints that exist, and the two homes outside the region.
#pragma once

#include "core/coupling.hpp"
#include "core/model.hpp"
#include "protocol/data_json.hpp"

namespace xr3 {

/// Checks whatever of the robot was read without error; adds a finding for each rule broken.
void check_robot(const Robot& robot, data::Reading& reading);

/// Positions at the hard home: every motor at its microswitch, coupling included (paper, Section III-A).
Positions hard_home(const Model& model);

}  // namespace xr3
