// The faults of a machine: set and cleared, begun and ended at their ticks. A tick at which a fault
// begins or ends is a stop of the advance of time (core/step.hpp), so that nothing happens at rest
// in between.
//
// The flow through the folder: a Fault (fault.hpp) is a value from a file or a call.
// install_faults() and set_fault() store it in State::faults (fault_state.hpp), and
// refresh_faults() derives the summary `now` from all of them: which motors are slow, which
// switches are stuck, and the tick of the next begin or end. pass_fault_stop() updates it at that
// tick. The code that a fault may disturb asks the summary first, at the cost of one comparison:
// motors, encoders, switches and grip (motor_faults.hpp), the bytes and replies of a line
// (line_faults.hpp), the camera's image (camera_faults.hpp). An effect by chance is decided by a
// hash of seed, name and place (chance.hpp), never by a generator, so that it does not depend on
// order. add_effect() counts each effect and appends an event. Nothing here reads files or moves
// bytes.
#pragma once

#include <string_view>

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Replaces all faults by those of a plan, without a history. Emits what begins at once.
void install_faults(const Model& model, State& state, const FaultPlan& plan, Events& events);

/// Adds a fault, or replaces the one with its name. A tick in the past means the current one.
/// Precondition: the joint exists, and there are fewer than kMaxFaults or one with this name.
void set_fault(const Model& model, State& state, Fault fault, Events& events);

/// Removes the fault with this name, or all of them if it is empty. Returns whether there was one.
bool clear_faults(const Model& model, State& state, std::string_view name, Events& events);

/// The fault with this name; nullptr if there is none.
const FaultState* find_fault(const State& state, std::string_view name);

/// Begins and ends the faults for which it is time. To be called in each tick that is a stop.
void pass_fault_stop(const Model& model, State& state, Events& events);

}  // namespace xr3
