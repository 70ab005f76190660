// The soft home (paper, Section III-A): where a robot begins, and where A$ puts it back.
#pragma once

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The state as the files say: soft home, counters 0, blocks where the workcell has them, tick 0.
State initial_state(const Model& model);

/// Joints and tool at the file's home values, counters 0, stall cleared; speeds, settings and digital
/// lines stay. A held block stays where it was.
void go_home(const Model& model, State& state, Events& events);

}  // namespace xr3
