// Advances the machine by one tick or many. The order in a tick is that of the lines of step():
// faults that begin or end, motors from the base to the tool and the carousel, protected region and
// surface, blocks on the carousel, switches, grasp, then arrived and blocked motors.
#pragma once

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Whether no motor will make a count without new input: each is done, blocked or stuck by a fault
/// without an end, or the robot is stalled. Faults may still begin or end.
bool is_at_rest(const Model& model, const State& state);

/// Advances by one tick.
void step(const Model& model, State& state, Events& events);

/// Advances to `target` or until the machine is at rest, whichever comes first. Skips over ticks in
/// which no motor makes a count and no fault begins or ends; the result is bit-identical to
/// repeated step(). Returns false if nothing but the tick has changed, which is so at rest without
/// faults that begin or end.
bool run_to_rest(const Model& model, State& state, Tick target, Events& events);

/// Advances to `target`; at rest the time that this takes depends only on the number of faults that
/// begin or end until then. Returns as run_to_rest().
bool advance_to(const Model& model, State& state, Tick target, Events& events);

}  // namespace xr3
