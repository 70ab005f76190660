// The status line (paper, Table V and Alt F4): one line of text about the robot, selected by A%n or
// by a key. For display only; the simulation does not use it.
#pragma once

#include <string>

#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The line selected by the state's status option: 0 blank, 1 tool-configuration vector (mm, then
/// dimensionless), 2 joint variables (degrees or mm), 3 error counters, 4 encoder positions,
/// 5 switches, 6 tool opening (mm) and the held block.
std::string status_line(const Model& model, const State& state);

}  // namespace xr3
