#include "core/stall.hpp"

#include <algorithm>
#include <functional>

#include "core/carousel.hpp"
#include "core/coupling.hpp"
#include "core/kinematics.hpp"

namespace xr3 {
namespace {

bool are_within_limits(const Model& model, const Positions& positions,
                       const std::vector<CoupledJoint>& joints) {
  return std::all_of(joints.begin(), joints.end(), [&](const CoupledJoint& driven) {
    return model.motor(driven.joint).excess(positions[driven.joint]) == 0;
  });
}

/// Whether some combination of at most one count per joint, from `joint` on, leads to positions for
/// which `is_such` holds.
bool leads_to(const Model& model, const Positions& positions, int joint,
              const std::function<bool(const Positions&)>& is_such) {
  if (joint == model.joint_count()) return is_such(positions);
  for (const Counts count : {0, -1, 1}) {
    Positions next = positions;
    turn(model, next, joint, count);
    if (are_within_limits(model, next, model.driven_by(joint)) &&
        leads_to(model, next, joint + 1, is_such)) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool is_in_protected_region(const Model& model, const Positions& positions, const PointUm& tip) {
  if (tip.z >= model.region_height_um()) return false;
  const PointUm base = base_shift(model, positions);
  const Micrometres radius = model.region_radius_um();
  const Micrometres x = tip.x - base.x;
  const Micrometres y = tip.y - base.y;
  return x * x + y * y < radius * radius;
}

bool is_below_surface(const Model& model, const PointUm& tip) {
  return tip.z < surface_um(model, tip.x, tip.y);
}

Stall stall_at(const Model& model, const State& state, const Positions& positions,
               const PointUm& tip) {
  if (is_in_protected_region(model, positions, tip)) return Stall::kProtectedRegion;
  const bool crosses = is_below_surface(model, tip) && !state.below_surface;
  return model.workcell().surface_stalls && crosses ? Stall::kWorkSurface : Stall::kNo;
}

bool could_stall(const Model& model, const Positions& positions, Stall why) {
  if (why == Stall::kNo) return true;
  const Micrometres height = tool_tip(model, positions).z;
  return leads_to(model, positions, 0, [&](const Positions& next) {
    const PointUm tip = tool_tip(model, next);
    const bool is_inside = is_in_protected_region(model, next, tip);
    if (why == Stall::kProtectedRegion) return is_inside;
    const bool is_sideways = is_over_carousel(model, tip.x, tip.y);
    return !is_inside && (tip.z < height || is_sideways);
  });
}

void update_surface(const Model& model, State& state, const PointUm& tip, Events& events) {
  const bool below = is_below_surface(model, tip);
  if (below && !state.below_surface) {
    events.push_back({state.tick, Warning{WarningCode::kBelowSurface, 'A', 0, 0, {}}});
  }
  state.below_surface = below;
}

}  // namespace xr3
