// The physical controller of a cell, which gets the commands of the lines while the simulator is
// disabled, and the simulation that may mirror it.
#pragma once

#include <cstdint>

#include "cell/output.hpp"
#include "cell/state.hpp"

namespace xr3 {

/// A byte of a line is about to act. Returns whether it goes to the device instead: then it has.
/// Precondition: there is a device.
bool act_on_device(CellState& cell, SerialLine& line, const ReceivedByte& in, CellOutput& out);

/// Inputs. Precondition: there is a device.
void open_device(CellState& cell, CellOutput& out);
void lose_device(CellState& cell, const DeviceLost& lost, CellOutput& out);
void receive_from_device(CellState& cell, const DeviceIn& in, CellOutput& out);

/// Forgets the inquiries that have waited too long for their answer. Precondition: there is a
/// device.
void expire_inquiries(CellState& cell, CellOutput& out);

void emit_device(CellState& cell, DeviceNews news, DeviceNote note, CellOutput& out);
/// The note of an event of the machine, which does not know that commands go to a device while it
/// is disabled.
CellNote note_of(const CellState& cell, EventBody event);
/// Whether the simulation stops where the arm goes on, for the first time. Jaws that close on a
/// block do so in both.
bool loses_mirror(CellState& cell, const EventBody& event);

}  // namespace xr3
