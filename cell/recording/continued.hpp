// A cell that goes on from the end of a recording, in another process: the state at the end, and a
// cell that begins with it.
#pragma once

#include <string>

#include "cell/cell.hpp"
#include "protocol/recording/header.hpp"

namespace xr3 {

/// Digest of the workcell and the faults with which the first of the recordings began that go on
/// from each other, up to this one.
std::string origin_of(const recording::Header& header);

/// The state with which a cell goes on. Precondition: no line is open, and there is no device.
recording::ContinuedState continued_state(const Cell& cell, std::string origin);

/// The cell, which is fresh and has the robot and profile of the header, continues from its start,
/// with its clock, faults and speed of lines, at `now`. A replay passes 0. Precondition: the header
/// has a start and no device.
void begin_at_start(Cell& cell, const recording::Header& header, WallNs now);

}  // namespace xr3
