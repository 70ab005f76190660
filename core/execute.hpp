// What each command does to the machine (paper, Tables VI and VII; hardware for K...R). The only
// way in which a serial line changes a state.
#pragma once

#include "core/command.hpp"
#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Carries out a command at the state's tick. Labels without a joint behind them take every command,
/// do nothing, answer like a joint at rest and raise a warning.
Reply execute(const Model& model, State& state, const Command& command, Events& events);

/// Sets input line 1...8 from outside.
void set_input(State& state, int line, bool high, Events& events);

}  // namespace xr3
