#include "core/drawing/strokes.hpp"

#include <utility>

namespace xr3 {

std::vector<Stroke> strokes_of(const std::vector<OutlinePoint>& outline) {
  std::vector<Stroke> strokes;
  Stroke drawn;
  const auto lift_pen = [&] {
    if (drawn.size() >= 2) strokes.push_back(std::move(drawn));
    drawn.clear();
  };
  for (const OutlinePoint& point : outline) {
    if (!point.draw) lift_pen();
    drawn.emplace_back(point.p_mm.x, point.p_mm.y, point.p_mm.z);
  }
  lift_pen();
  return strokes;
}

}  // namespace xr3
