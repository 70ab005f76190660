// Triangles of a simple polygon.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace xr3 {

/// Indices of three corners, in the order of the polygon.
using CornerIndices = std::array<std::size_t, 3>;

/// The triangles of a polygon with at least three corners, counterclockwise, by ear clipping. A
/// polygon that crosses itself gets as many triangles, which may overlap.
std::vector<CornerIndices> triangulated(const std::vector<Eigen::Vector2d>& polygon);

}  // namespace xr3
