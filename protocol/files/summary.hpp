// Summaries of robots and workcells as text, for `xr3 check` and the workcell editor.
#pragma once

#include <string>

#include "core/model.hpp"

namespace xr3 {

/// A summary of a robot: Denavit-Hartenberg table, motors, coupling, protected region, net roll and
/// both homes (paper, Table II and Section III-A).
std::string robot_summary(const Robot& robot, Profile profile);

/// A summary of a workcell: workspace, blocks and camera (paper, Section III-B).
std::string workcell_summary(const Workcell& workcell);

}  // namespace xr3
