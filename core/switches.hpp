// Microswitches (paper, Sections II-B and III-A): one per motor, a pure function of the motor's
// count. And the controller's digital lines and ports.
#pragma once

#include "core/command.hpp"
#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Whether the reply to `inquiry` includes the switch of joint `label`: I has C...H, J has A and B.
bool is_asked_for(char label, char inquiry);

/// Whether the microswitch of a motor is closed at this count; see closed_range().
bool is_closed(const MotorModel& motor, Counts count);

/// Recomputes the switches of these motors and appends an event for each change. A switch that is
/// stuck by a fault does not follow its motor.
void update_switches(const Model& model, State& state, Events& events,
                     MotorBits motors = kAllMotors);

/// Switches output line 1...8.
void set_output(State& state, int line, bool high, Events& events);

/// Switches auxiliary port 1 or 2.
void set_auxiliary(State& state, int port, bool on, Events& events);

/// Input line 1...8 from outside.
void set_input(State& state, int line, bool high, Events& events);

/// The reply to inquiry 'I', 'J' or 'K'.
SwitchBits switch_bits(const Model& model, const State& state, char inquiry);

}  // namespace xr3
