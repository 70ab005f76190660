// The rules of robot files that concern more than one field: distinct labels and masks,
// homes and switches within limits, references to existing joints, and both homes outside the
// protected region.
#pragma once

#include "core/coupling.hpp"
#include "core/model.hpp"
#include "protocol/json/codec.hpp"

namespace xr3 {

/// Checks the parts of the robot that were read without errors. Adds a finding for each violated
/// rule.
void check_robot(const Robot& robot, data::Reading& reading);

/// Positions at the hard home: every motor at its microswitch, coupling included (paper,
/// Section III-A).
Positions hard_home(const Model& model);

}  // namespace xr3
