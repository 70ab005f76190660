// The rules of workcell files that concern more than one field. Errors: duplicate names, a camera
// that is not above the work surface or is reached by a block. Warnings: blocks that overlap,
// float, lie below the work surface or outside the workspace, are too wide for the robot's tool or
// out of its reach.
#pragma once

#include "core/robot.hpp"
#include "core/workcell.hpp"
#include "protocol/json/codec.hpp"

namespace xr3 {

/// Checks the parts of the workcell that were read without errors. `robot` may be nullptr. The
/// reach is checked for the blocks from index `first_reach` on; if the robot's inverse kinematics
/// has no closed form, for 100 of them.
void check_workcell(const Workcell& workcell, const Robot* robot, std::size_t first_reach,
                    data::Reading& reading);

/// Maximum opening of the robot's jaws, in mm.
double widest_opening_mm(const Robot& robot);

}  // namespace xr3
