#include "protocol/goals/goal.hpp"

namespace xr3 {

bool BoxUm::contains(const PointUm& point) const {
  const auto is_in = [](Micrometres least, Micrometres at, Micrometres most) {
    return least <= at && at <= most;
  };
  return is_in(low.x, point.x, high.x) && is_in(low.y, point.y, high.y) &&
         is_in(low.z, point.z, high.z);
}

}  // namespace xr3
