// The parts of a robot file that are only drawn: points, outlines of links, and the parts of the tool
// that move when it does (paper, Section III-A, Link Data and Tool Data).
#pragma once

#include "core/robot.hpp"
#include "protocol/data_json.hpp"

namespace xr3::data {

Members<Outline> outline_members();
Members<ToolPart> tool_part_members();

}  // namespace xr3::data
