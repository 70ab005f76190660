// The places that the tool tip may not enter: the protected region about the base axis (paper,
// Section III-A) and the space below the work surface. Crossing the surface downwards warns, or
// stalls the robot if the workcell has surface_stalls.
#pragma once

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Whether r < radius and z < height of the protected cylinder, in whole micrometres. The cylinder
/// stands about the base axis, with which it moves if the arm is on a slide: see base_shift().
bool is_in_protected_region(const Model& model, const Positions& positions, const PointUm& tip);

/// Whether the tip is below the work surface, or the top of the carousel within its radius; at its
/// height it is not.
bool is_below_surface(const Model& model, const PointUm& tip);

/// The reason why a robot with its tip here stalls, or kNo. A tip that is already below the surface
/// may move on there.
Stall stall_at(const Model& model, const State& state, const Positions& positions,
               const PointUm& tip);

/// Whether one tick from these positions can cause this stall, in this workcell or in one that has
/// been replaced since. A stalled robot keeps the positions it had before the tick.
bool could_stall(const Model& model, const Positions& positions, Stall why);

/// Updates State::below_surface and appends one warning per downward crossing.
void update_surface(const Model& model, State& state, const PointUm& tip, Events& events);

}  // namespace xr3
