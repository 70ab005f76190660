// What one field of a workcell file cannot say alone. Errors: names given twice, a camera that cannot
// see the work surface or is reached by a block. Warnings: blocks that overlap, float, lie under the
// work surface or outside the workspace, or are too wide for the robot's tool.
#pragma once

#include "core/robot.hpp"
#include "core/workcell.hpp"
#include "protocol/data_json.hpp"

namespace xr3 {

/// Checks whatever of the workcell was read without error; `robot` may be null.
void check_workcell(const Workcell& workcell, const Robot* robot, data::Reading& reading);

/// Widest opening of the robot's jaws, in mm.
double widest_opening_mm(const Robot& robot);

}  // namespace xr3
