// The pen path of an outline as polylines.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/robot.hpp"

namespace xr3 {

/// At least two points, mm, joined by lines.
using Stroke = std::vector<Eigen::Vector3d>;

/// One stroke for each run of lines; a point without a line is not among them.
std::vector<Stroke> strokes_of(const std::vector<OutlinePoint>& outline);

}  // namespace xr3
