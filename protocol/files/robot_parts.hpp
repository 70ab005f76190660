// The members of a robot file that describe its parts: the motor of a joint or of the tool (paper,
// Table II), and the outlines of links and of the tool's moving parts (Section III-A, Link Data and
// Tool Data).
#pragma once

#include <string>
#include <vector>

#include "core/robot.hpp"
#include "protocol/json/codec.hpp"

namespace xr3::data {

/// The members of a motor with these names, in this order: label, precision (above 0), limits
/// ([min, max] of the variable), speed, direction, home (the variable at the soft home; only the
/// tool has it) and switch. Precision, limits and home are in degrees, or in the file's length unit
/// until convert_lengths() is called.
Members<Drive> drive_members(const std::vector<std::string>& names);

/// Converts precision and limits of a drive whose variable is a length to mm.
void convert_lengths(Drive& drive, double mm_per_unit);

Members<Outline> outline_members();
Members<ToolPart> tool_part_members();

}  // namespace xr3::data
