// Where the tool tip may be: outside the protected region about the base axis (paper, Section III-A),
// and above the work surface, where passing under it warns or, if the workcell says so, stalls.
#pragma once

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// r < radius and z < height of the protected cylinder, in whole micrometres.
bool is_in_protected_region(const Model& model, const PointUm& tip);

bool is_below_surface(const Model& model, const PointUm& tip);

/// Why the robot must stall if its tip were here; kNo where it may be. A tip that is already under
/// the surface may move there.
Stall stall_at(const Model& model, const State& state, const PointUm& tip);

/// Some tick from these positions leads the tip to where it stalls for this reason, in this workcell or
/// in one that has been replaced since: a stall leaves the joints where they were.
bool could_stall(const Model& model, const Positions& positions, Stall why);

/// Remembers the side of the work surface and warns once a crossing downwards.
void update_surface(const Model& model, State& state, const PointUm& tip, Events& events);

}  // namespace xr3
