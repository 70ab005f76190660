#include "core/state.hpp"

namespace xr3 {

void TipPath::add(const PointUm& tip) {
  if (points.size() < kMaxTipPoints) {
    points.push_back(tip);
    return;
  }
  points[oldest] = tip;
  oldest = (oldest + 1) % kMaxTipPoints;
}

}  // namespace xr3
