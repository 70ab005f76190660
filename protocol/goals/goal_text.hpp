// Lengths, points and other parts of the sentences about goals.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/units.hpp"
#include "protocol/goals/goal.hpp"

namespace xr3 {

/// A length in mm with at most one decimal: `262`, `0.5`.
std::string mm_text(Micrometres length);
/// An angle in degrees with at most one decimal.
std::string degrees_text(Microdegrees angle);
/// Simulated seconds with at most three decimals: `1.25`.
std::string seconds_text(Tick ticks);
/// `x 262, y 0, z 20 mm`.
std::string point_text(const PointUm& point);
/// The coordinates that count: `x 262, z 20 mm`.
std::string point_text(const PartialPoint& point);
/// `x 100 to 200, y -50 to 50, z 0 to 40 mm`.
std::string box_text(const BoxUm& box);
/// `red, green and blue`.
std::string names_text(const std::vector<std::string>& names);

}  // namespace xr3
