// Time by the byte clock: that of characters, inquiries and replies, the turns of the lines, the
// robot that runs to rest, and the transcript.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "cell/output.hpp"
#include "cell/state.hpp"

namespace xr3 {

// --- Turns. With a byte clock, lines are obeyed one after the other, in the order in which they
// were opened, unless its settings let them all.

/// The line that is obeyed now; nullopt: none is open, or all are obeyed together.
std::optional<LineId> current_line(const CellState& cell);
/// The line that a line waits for, unread; nullopt: it does not wait, or is not open.
std::optional<LineId> line_before(const CellState& cell, LineId line);
/// The line that was obeyed, or the last one, has closed: the robot runs to rest, and the next line
/// has its turn. So nothing depends on whether that line was opened before or after.
void end_turn(CellState& cell, LineCloseReason reason, CellOutput& out);

// --- Time. No effect unless bytes move it.

/// Lets the time of a character pass before its byte acts. Returns false if a fault has cut the
/// line in that time: the byte must not act.
bool pass_character(CellState& cell, SerialLine& line, std::uint8_t byte, CellOutput& out);
/// Lets the time of an inquiry pass before it is executed; other commands take none. Returns false
/// if a fault has cut the line: the command must not be executed.
bool pass_command(CellState& cell, SerialLine& line, const Command& command, CellOutput& out);
/// The replies that have left take their time, and time jumps over what holds back others.
void pass_delays(CellState& cell, CellOutput& out);
/// The robot runs until nothing moves, by at most kMaxSleep. This is bounded work: error counters
/// have 8 bits.
void rest(CellState& cell, CellOutput& out);
/// The settings that give a line's bytes their time; nullopt: they take none.
std::optional<SerialSettings> speed_of(const CellState& cell, const SerialLine& line);

// --- The transcript. No effect without one.

/// Bytes of a reply, as they were before the telnet filter, have gone to the outbox.
void note_reply(CellState& cell, const SerialLine& line, std::string_view reply);
void mark(CellState& cell, TranscriptMark mark);
void note_end(CellState& cell, LineId line, LineCloseReason reason);
/// The port of a pseudo-terminal reports its settings, which the line does not have yet.
void note_settings(CellState& cell, const SerialLine& line, const SerialSettings& reported);
/// A new epoch has begun.
void restart_bytes(CellState& cell);

}  // namespace xr3
