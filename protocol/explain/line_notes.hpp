// Diagnostics of a line that none of its bytes caused.
#pragma once

#include "protocol/explain/cell_event.hpp"

namespace xr3 {

/// `disabled`: a line was opened while the simulator is disabled.
ProblemNote disabled_note();

/// `pty_cooked`: a program has the pseudo-terminal echo, or edit lines.
ProblemNote cooked_note();

/// `byte_clock_hurry`: with the byte clock, a joint gets motion commands and is never asked whether
/// it has arrived.
ProblemNote hurry_note(char label);

/// `device_silent`: the device did not answer an inquiry of the line in time.
ProblemNote silent_note(const Command& inquiry);

}  // namespace xr3
