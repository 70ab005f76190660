// Time: one tick of the machine, and many. The order within a tick is the order of the lines of
// step(): motors from the base to the tool, the region once, switches, what came to stand or arrived.
#pragma once

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// No motor would make a count without new input: each is done, blocked, or the robot is stalled.
bool is_at_rest(const Model& model, const State& state);

/// One tick.
void step(const Model& model, State& state, Events& events);

/// Ticks until `target` or until the machine is at rest, whichever comes first. Ticks in which no
/// motor makes a count are taken together; the result is the same, bit for bit, as with step().
void run_to_rest(const Model& model, State& state, Tick target, Events& events);

/// Ticks until `target`, in constant time from the moment the machine is at rest.
void advance_to(const Model& model, State& state, Tick target, Events& events);

}  // namespace xr3
