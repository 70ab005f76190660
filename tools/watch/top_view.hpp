// The workspace from above in characters, for a terminal: x to the right and y upwards, as in the
// camera's picture, with the robot's base at the left edge.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/workcell.hpp"

namespace xr3 {

/// Whether the robot reaches a point of the work surface; x and y in mm. Empty if not known.
using ReachAbove = std::function<bool(double x_mm, double y_mm)>;

/// The picture as lines that end with line feeds: at most 80 columns and 36 lines, and a legend
/// with the blocks' letters. Reachable points are dots; colons are the edge of the camera's field.
std::string top_view(const Workcell& workcell, const ReachAbove& reaches);

/// The letter, or digit, of each block in the view: the first of its name; the last one that is
/// free, if an earlier block has that; or any that is free. `#`: all are in use. R is the robot.
std::string block_letters(const std::vector<Block>& blocks);

}  // namespace xr3
