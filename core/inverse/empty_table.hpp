// The workcell of a robot that has no workcell file.
#pragma once

#include "core/inverse/reach.hpp"
#include "core/workcell.hpp"

namespace xr3 {

/// A table without blocks and without a camera, as large as the robot reaches and a little more.
/// Its surface is at z = 0, or as low above that as the hand reaches it from straight above. If the
/// inverse kinematics has no closed form, the surface is at 0, and the size is an upper bound.
Workcell empty_table(const Reach& reach);

}  // namespace xr3
