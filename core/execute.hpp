// What each command does to the machine (paper, Tables VI and VII; hardware for K...R). The only
// way in which a serial line changes a state.
#pragma once

#include "core/camera_cache.hpp"
#include "core/command.hpp"
#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Carries out a command at the state's tick. Labels without a joint behind them take every command,
/// do nothing, answer like a joint at rest and raise a warning. `camera` has been told of every change
/// since it was asked last.
Reply execute(const Model& model, State& state, const Command& command, Events& events,
              CameraCache& camera);

/// It asks only what the camera sees, and so changes nothing that it sees.
bool is_camera_inquiry(const Command& command);

/// Sets input line 1...8 from outside.
void set_input(State& state, int line, bool high, Events& events);

}  // namespace xr3
