// Advances the machine by one tick or many. The order within a tick is that of the lines of step():
// motors from the base to the tool and the carousel, protected region and work surface, blocks on
// the carousel, switches, grasp, then arrived and blocked motors.
#pragma once

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// No motor will make a count without new input: each is done or blocked, or the robot is stalled.
bool is_at_rest(const Model& model, const State& state);

/// One tick.
void step(const Model& model, State& state, Events& events);

/// Advances to `target` or until the machine is at rest, whichever comes first. Skips over ticks in
/// which no motor makes a count; the result is bit-identical to repeated step(). Returns false
/// if nothing but the tick has changed.
bool run_to_rest(const Model& model, State& state, Tick target, Events& events);

/// Advances to `target`; takes constant time once the machine is at rest. Returns as run_to_rest().
bool advance_to(const Model& model, State& state, Tick target, Events& events);

}  // namespace xr3
