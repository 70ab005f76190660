#include "protocol/scene/triangulation.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace xr3 {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

/// Twice the area of a triangle; positive if it is counterclockwise.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool contains(const Polygon& polygon, const CornerIndices& ear, const Eigen::Vector2d& p) {
  const Eigen::Vector2d &a = polygon[ear[0]], &b = polygon[ear[1]], &c = polygon[ear[2]];
  return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
         turn(c, a, p) >= 0;
}

/// The triangle of the corner `at` of those that are left and of its neighbours.
CornerIndices corner_at(const std::vector<std::size_t>& left, std::size_t at) {
  return {left[(at + left.size() - 1) % left.size()], left[at], left[(at + 1) % left.size()]};
}

bool is_ear(const Polygon& polygon, const std::vector<std::size_t>& left, std::size_t at) {
  const CornerIndices ear = corner_at(left, at);
  return turn(polygon[ear[0]], polygon[ear[1]], polygon[ear[2]]) > 0 &&
         std::none_of(left.begin(), left.end(),
                      [&](std::size_t i) { return contains(polygon, ear, polygon[i]); });
}

/// The first ear; 0 if there is none, as in a polygon that crosses itself.
std::size_t first_ear(const Polygon& polygon, const std::vector<std::size_t>& left) {
  for (std::size_t at = 0; at < left.size(); ++at)
    if (is_ear(polygon, left, at)) return at;
  return 0;
}

}  // namespace

std::vector<CornerIndices> triangulated(const Polygon& polygon) {
  assert(polygon.size() >= 3);
  std::vector<std::size_t> left(polygon.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::vector<CornerIndices> triangles;
  while (left.size() > 3) {
    const std::size_t ear = first_ear(polygon, left);
    triangles.push_back(corner_at(left, ear));
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace xr3
