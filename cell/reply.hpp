// The way of a reply, from the command that it answers to the outbox of its line: faults may change
// or delay it, the client may have suspended it, and with a speed it takes its time.
#pragma once

#include <string_view>

#include "cell/output.hpp"
#include "cell/state.hpp"

namespace xr3 {

/// A command has its reply at `now`.
void answer(CellState& cell, SerialLine& line, std::string_view reply, const wire::Meaning& meaning,
            Micros now, CellOutput& out);
/// A reply goes on behind the faults: into the outbox, unless it must wait.
void pass_on(CellState& cell, SerialLine& line, std::string_view reply,
             const wire::Meaning& meaning, Micros now, CellOutput& out);
/// Replies that a fault has held back go on, at the speed of the line. Precondition: some are due.
void release(CellState& cell, SerialLine& line, Micros now, CellOutput& out);
/// The byte of a reply that is due goes to the outbox. Precondition: the line's due(kOut) has come.
void send_due(CellState& cell, SerialLine& line, Micros now, CellOutput& out);

/// Obeys a command of telnet about bytes in transit.
void control(CellState& cell, SerialLine& line, BufferControl control, Micros now, CellOutput& out);
/// Replies are no longer suspended.
void resume(CellState& cell, SerialLine& line, Micros now, CellOutput& out);

}  // namespace xr3
