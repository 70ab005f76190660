// The way of a byte, from the transport to the command that it completes.
#pragma once

#include <cstddef>
#include <string_view>

#include "cell/output.hpp"
#include "cell/state.hpp"

namespace xr3 {

/// Whether the line takes a byte now. Otherwise its transport waits until it is woken, or has sent
/// bytes of the outbox.
bool accepts(const CellState& cell, const SerialLine& line, char next);
/// Whether the bytes of an open line wait: for another line, with a byte clock only, or because the
/// cell is in the past.
bool is_unread(const CellState& cell, LineId line);

/// Receives bytes that belong together in one record, at most kMaxShownIn of these. With a byte
/// clock it ends with the command that they complete, and what that brings about has happened when
/// this returns; with a speed, they are data only, or commands of telnet. Returns the number of
/// bytes taken: 0 if the line accepts none.
std::size_t receive(CellState& cell, SerialLine& line, std::string_view bytes, CellOutput& out);

/// A byte of data acts on the controller, at `now`.
void act(CellState& cell, SerialLine& line, const ReceivedByte& in, Micros now, CellOutput& out);

}  // namespace xr3
