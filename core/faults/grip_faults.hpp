// Faults that let a held block fall while the arm carries it.
#pragma once

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// To be called in each tick in which a joint of the arm has moved: the held block, if any, may
/// slip out of the jaws.
void slip_grip(const Model& model, State& state, const Positions& positions, Events& events);

}  // namespace xr3
