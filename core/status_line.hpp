// The status line (paper, Table V and Alt F4): one line of text about the robot, chosen by A%n or by a
// key. For people only: it decides nothing.
#pragma once

#include <string>

#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The line as the state's option has it: 0 blank, 1 tool-configuration vector (mm, then
/// dimensionless), 2 joint variables (degrees or mm), 3 error counters, 4 encoder positions,
/// 5 switches, 6 tool opening (mm) and what it holds.
std::string status_line(const Model& model, const State& state);

}  // namespace xr3
