// The soft home (paper, Section III-A): where the robot starts, and where A$ moves it. And the
// reset of the controller, which moves nothing.
#pragma once

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The initial state: soft home, counters 0, blocks as in the workcell file, tick 0.
State initial_state(const Model& model);

/// Moves joints and tool to the file's home values at once, sets the counters to 0 and clears a
/// stall. Speeds, settings and digital lines are unchanged. A held block is released where it is.
void go_home(const Model& model, State& state, Events& events);

/// Sets the error counters to 0, outputs and ports off, and speeds to those of the file; no homing.
void reset_controller(const Model& model, State& state, Events& events);

}  // namespace xr3
