// Values of the simulation as JSON with rounded numbers: points in mm, the clock.
#pragma once

#include "core/sim_clock.hpp"
#include "core/units.hpp"
#include "protocol/json/source.hpp"

namespace xr3 {

/// Decimals of numbers in the monitor's messages.
inline constexpr int kMmDecimals = 3;
inline constexpr int kDegreeDecimals = 4;
inline constexpr int kMatrixDecimals = 5;

/// Rounds to `decimals` (0...9) decimals; never -0. As JSON has neither, infinity becomes the
/// maximum double and NaN becomes 0.
double rounded(double value, int decimals);

/// A point in mm: `[250.0,60.0,15.0]`.
Json point_json(const PointUm& point);

/// `{"mode":"real","rate":1.0}`; the rate is in simulated seconds per wall second.
Json clock_json(ClockMode mode, Rate rate);

}  // namespace xr3
