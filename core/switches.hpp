// Microswitches (paper, Sections II-B and III-A): one a joint, a pure function of its motor's count.
#pragma once

#include "core/command.hpp"
#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Whether `I` or `J` asks for the switch of a joint: I for C...H, J for A and B.
bool is_asked_for(char label, char inquiry);

/// Closed at the position and beyond it as seen from the soft home, so that it stays closed while the
/// joint goes on the way that closed it; with a width, only near the position, as on the hardware.
bool is_closed(const Microswitch& microswitch, Counts count);

/// Brings every motor's switch up to date with its count and tells of each that changed.
void update_switches(const Model& model, State& state, Events& events);

/// Bits for the inquiries I, J and K; see controller's commands in command.hpp.
SwitchBits switch_bits(const Model& model, const State& state, char inquiry);

}  // namespace xr3
