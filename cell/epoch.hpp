// Epochs: what begins one, and the cell that was taken back to its past.
#pragma once

#include <functional>
#include <string_view>

#include "cell/output.hpp"
#include "cell/state.hpp"
#include "protocol/monitor/call.hpp"

namespace xr3 {

/// Begins an epoch with this change of the machine. `call` is the name of what caused it, a
/// constant.
void begin_epoch(CellState& cell, std::string_view call, WallNs now,
                 const std::function<void()>& change, CellOutput& out);

/// The cell is taken back: time stands, lines are not read, and calls that change the cell are
/// refused with in_the_past(), until the call `resume`. The clock is then as it was before.
/// Precondition: there is no device.
void take_back(CellState& cell, const Rewind& rewind, WallNs now, CellOutput& out);
/// The cell goes on from where it was taken: bytes of the lines are read again. No effect if it was
/// not taken back.
void end_past(CellState& cell, CellOutput& out);
/// The refusal of calls that would change a cell in its past.
call::Refused in_the_past();

/// The workcell has changed. `call` is the name of what caused it, a constant.
void changed_model(CellState& cell, std::string_view call, const std::string& name,
                   CellOutput& out);

}  // namespace xr3
