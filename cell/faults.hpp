// What faults on demand do to the lines of a cell beyond their bytes.
#pragma once

#include "cell/output.hpp"
#include "cell/state.hpp"

namespace xr3 {

/// Cuts the lines that an event of a fault disconnects; no effect for other events.
void cut_lines(CellState& cell, const EventBody& event, CellOutput& out);

}  // namespace xr3
