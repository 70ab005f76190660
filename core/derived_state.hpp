// The derived part of a state, recomputed from the rest. Core updates it incrementally; this is for
// states from outside, such as snapshots, and uses the functions of the incremental update.
#pragma once

#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Recomputes switches, blocked motors, the phase of motors at rest, the side of the work surface,
/// and the entries of the held block and of blocks on the carousel, from counts, error counters,
/// settings, grasp and riders. Precondition: positions are within their limits. Invariant:
/// derived(m, s) == s for every reachable state.
State derived(const Model& model, State state);

}  // namespace xr3
