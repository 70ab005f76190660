// The members of a robot file for drawing: points, outlines of links, and the moving parts of the
// tool (paper, Section III-A, Link Data and Tool Data).
#pragma once

#include "core/robot.hpp"
#include "protocol/json/codec.hpp"

namespace xr3::data {

Members<Outline> outline_members();
Members<ToolPart> tool_part_members();

}  // namespace xr3::data
