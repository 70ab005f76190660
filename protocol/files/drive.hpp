// The members of a robot file that describe the motor of a joint or of the tool: label, precision,
// limits, speed, direction, home and microswitch (paper, Table II).
#pragma once

#include "core/robot.hpp"
#include "protocol/json/codec.hpp"

namespace xr3::data {

Member<Drive> label_member();
/// Above 0; in degrees, or in the file's length unit until convert_lengths() is called.
Member<Drive> precision_member();
/// [min, max] of the variable, in the same units.
Member<Drive> limits_member();
Member<Drive> speed_member();
Member<Drive> direction_member();
/// The variable at the soft home, in the same units. Only the tool has this member.
Member<Drive> home_member();
Member<Drive> switch_member();

/// 1 or -1.
Codec<int> sign();

/// Converts precision and limits of a drive whose variable is a length to mm.
void convert_lengths(Drive& drive, double mm_per_unit);

}  // namespace xr3::data
