// The invariants of a machine's state. They hold after every tick and every command; builds without
// NDEBUG assert them at the end of step() and execute().
#pragma once

#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The first invariant that the state violates, as a sentence; nullptr if all of them hold. Linear
/// in the number of motors, and of blocks on the carousel.
const char* broken_invariant(const Model& model, const State& state);

}  // namespace xr3
