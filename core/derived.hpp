// What in a state follows from the rest of it. Core keeps it up to date where it changes; here it is
// worked out anew by the same functions, for a state that comes from outside.
#pragma once

#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The state with switches, blocked motors, the phase of motors that stand, the side of the work surface
/// and the held block's entry worked out from counts, counters, settings and the grasp. Every state that
/// a machine with this model comes to is its own derived state. Positions are within their limits.
State derived(const Model& model, State state);

}  // namespace xr3
