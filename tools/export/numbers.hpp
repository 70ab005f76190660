// Numbers and colours as texts of attributes, in metres and radians.
#pragma once

#include <Eigen/Core>
#include <string>

namespace xr3 {

inline constexpr double kMetresPerMm = 0.001;

/// A number with twelve decimals, which keep a chain of places within 1e-9 m.
std::string number_text(double value);
/// Numbers separated by blanks.
std::string numbers_text(const Eigen::Vector3d& values);
/// Lengths in metres, separated by blanks.
std::string metres_text(const Eigen::Vector3d& mm);

/// A palette index as red, green, blue and opacity, 0...1, separated by blanks.
std::string color_text(int color);

}  // namespace xr3
