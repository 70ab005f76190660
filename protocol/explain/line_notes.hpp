// Diagnostics of a line that none of its bytes caused.
#pragma once

#include "protocol/explain/cell_event.hpp"

namespace xr3 {

/// `disabled`: a line was opened while the simulator is disabled.
ProblemNote disabled_note();

/// `pty_cooked`: a program has the pseudo-terminal echo, or edit lines.
ProblemNote cooked_note();

/// `device_silent`: the device did not answer an inquiry of the line in time.
ProblemNote silent_note(const Command& inquiry);

}  // namespace xr3
