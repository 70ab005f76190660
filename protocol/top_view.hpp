// The workspace from above in characters, for a terminal: the robot's base at the bottom, x going up
// and y to the left, as one who stands behind the robot sees it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "core/workcell.hpp"

namespace xr3 {

/// Whether the robot reaches a place of the work surface; x and y in mm. May be empty: not known.
using ReachAbove = std::function<bool(double x_mm, double y_mm)>;

/// Lines ended by line feeds, at most 80 columns wide, the picture at most 24 lines high; below it a
/// legend with the blocks' letters. Places that the robot reaches are dotted, the edge of the camera's
/// field is drawn with colons.
std::string top_view(const Workcell& workcell, const ReachAbove& reaches);

/// a...z, then A...Z, `#` for all later blocks; R, the robot, is left out.
char block_letter(std::size_t index);

}  // namespace xr3
