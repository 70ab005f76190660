// The drawing of a robot whose file has no outlines, made of its Denavit-Hartenberg rows.
#pragma once

#include <optional>

#include "core/robot.hpp"

namespace xr3 {

/// The robot with outlines; nullopt if it has its own. For each joint a line along d, then along a,
/// and a marker about its axis, a prism with six sides if it turns, with four if it slides. The
/// line of a sliding joint is as long as its range, and slides through the marker. A tool without
/// parts gets two jaws.
std::optional<Robot> stick_figure(const Robot& robot);

}  // namespace xr3
