// The invariants of a machine's state: what holds after every tick and every command. Builds without
// NDEBUG assert them at the end of step() and execute().
#pragma once

#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Names the first invariant that the state breaks, as a sentence; nullptr if all of them hold. Linear in
/// the number of motors; a held block costs one pose.
const char* broken_invariant(const Model& model, const State& state);

}  // namespace xr3
