// The status line (paper, Table V and Alt F4): one line of text about the robot, selected by A%n or
// by a key. For display only; the simulation does not use it.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The content of each option. The vector is in mm, then dimensionless; joint variables are in
/// degrees or mm; the opening is in mm, with the held block.
inline constexpr std::array<std::string_view, 7> kStatusLines{
    "blank",          "tool-configuration vector", "joint variables",
    "error counters", "encoder positions",         "switches",
    "tool opening"};

/// The line selected by the state's status option, an index of kStatusLines.
std::string status_line(const Model& model, const State& state);

}  // namespace xr3
