// Microswitches (paper, Sections II-B and III-A): one per motor, a pure function of the motor's
// count.
#pragma once

#include "core/command.hpp"
#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Whether the reply to `inquiry` includes the switch of joint `label`: I has C...H, J has A and B.
bool is_asked_for(char label, char inquiry);

/// Without a width: closed at its position and beyond it, seen from the soft home, so that it stays
/// closed while the joint moves on. With a width: closed only near its position, as on the
/// hardware.
bool is_closed(const Microswitch& microswitch, Counts count);

/// Recomputes every switch and appends an event for each change.
void update_switches(const Model& model, State& state, Events& events);

/// The reply to inquiry 'I', 'J' or 'K'.
SwitchBits switch_bits(const Model& model, const State& state, char inquiry);

}  // namespace xr3
