// Microswitches (paper, Sections II-B and III-A): one per motor, a pure function of the motor's
// count. Also the controller's digital lines and ports.
#pragma once

#include <array>
#include <cstdint>

#include "core/command.hpp"
#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Whether the reply to `inquiry` includes the switch of joint `label`: I has C...H, J has A and B.
bool is_asked_for(char label, char inquiry);

/// The bits of input lines 5...8, in this order, in the reply to J.
using InputMasks = std::array<std::uint8_t, 4>;
inline constexpr int kFirstInputOfJ = 5;

/// The bits of the input lines in the reply to J: those that the switches of A and B leave free,
/// from the lowest. With masks of 0, 1 and 2 only, as in files of version 0.1: bits 2...5.
InputMasks input_masks_of_j(std::uint8_t mask_of_a, std::uint8_t mask_of_b);

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

/// Sets input line 1...8 from outside.
void set_input(State& state, int line, bool high, Events& events);

/// The reply to inquiry 'I', 'J' or 'K'.
SwitchBits switch_bits(const Model& model, const State& state, char inquiry);

}  // namespace xr3
