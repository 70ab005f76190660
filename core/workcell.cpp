#include "core/workcell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/trig.hpp"

namespace xr3 {
namespace {

SinCos direction_of(const Block& block) { return sin_cos_deg(degrees(block.yaw_udeg)); }
SinCos a_quarter_on(const SinCos& direction) { return {direction.cos, -direction.sin}; }

/// Half the extent of the footprint in a horizontal direction, in mm.
double reach_mm(const Block& block, const SinCos& yaw, const SinCos& direction) {
  const double along = yaw.cos * direction.cos + yaw.sin * direction.sin;
  const double across = yaw.cos * direction.sin - yaw.sin * direction.cos;
  return (mm(block.size_um.x) * std::abs(along) + mm(block.size_um.y) * std::abs(across)) / 2;
}

}  // namespace

// The separating axis test: convex footprints overlap by the least of their overlaps in the
// directions of their sides.
Micrometres footprint_overlap_um(const Block& a, const Block& b) {
  const double dx = mm(b.centroid_um.x - a.centroid_um.x);
  const double dy = mm(b.centroid_um.y - a.centroid_um.y);
  const SinCos yaw_a = direction_of(a);
  const SinCos yaw_b = direction_of(b);
  Micrometres least = std::numeric_limits<Micrometres>::max();
  for (const SinCos& side : {yaw_a, a_quarter_on(yaw_a), yaw_b, a_quarter_on(yaw_b)}) {
    const double between = std::abs(dx * side.cos + dy * side.sin);
    const double reach = reach_mm(a, yaw_a, side) + reach_mm(b, yaw_b, side);
    least = std::min(least, micrometres(reach - between));
  }
  return least;
}

}  // namespace xr3
