// The rules of workcell files that concern more than one field. Errors: duplicate names, a camera
// that is not above the work surface or is reached by a block. Warnings: blocks that overlap,
// float, lie below the work surface or outside the workspace, or are too wide for the robot's tool.
#pragma once

#include "core/robot.hpp"
#include "core/workcell.hpp"
#include "protocol/json/codec.hpp"

namespace xr3 {

/// Checks the parts of the workcell that were read without errors. `robot` may be nullptr.
void check_workcell(const Workcell& workcell, const Robot* robot, data::Reading& reading);

/// Maximum opening of the robot's jaws, in mm.
double widest_opening_mm(const Robot& robot);

}  // namespace xr3
