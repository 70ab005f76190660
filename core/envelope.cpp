#include "core/envelope.hpp"

namespace xr3 {

bool is_in_protected_region(const Model& model, const PointUm& tip) {
  const Micrometres radius = model.region_radius_um();
  return tip.z < model.region_height_um() && tip.x * tip.x + tip.y * tip.y < radius * radius;
}

bool is_below_surface(const Model& model, const PointUm& tip) {
  return tip.z < model.workcell().work_surface_um;
}

Stall stall_at(const Model& model, const State& state, const PointUm& tip) {
  if (is_in_protected_region(model, tip)) return Stall::kProtectedRegion;
  const bool crosses = is_below_surface(model, tip) && !state.below_surface;
  return model.workcell().surface_stalls && crosses ? Stall::kWorkSurface : Stall::kNo;
}

void update_surface(const Model& model, State& state, const PointUm& tip, Events& events) {
  const bool below = is_below_surface(model, tip);
  if (below && !state.below_surface) {
    events.push_back({state.tick, Warning{WarningCode::kBelowSurface, 'A', 0, 0, {}}});
  }
  state.below_surface = below;
}

}  // namespace xr3
