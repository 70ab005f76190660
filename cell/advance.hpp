// The passing of time in a cell: bytes of the lines act and leave when they are due, and between
// them the machine moves.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "cell/output.hpp"
#include "cell/state.hpp"

namespace xr3 {

/// An advance of real time stops after the tick in which this number of due bytes of lines is
/// reached, if more are due: the clock is set back to that tick, and goes on from there.
inline constexpr std::size_t kMaxDueBytes = 256;
/// Maximum number of due bytes of lines in a tick of the real clock; further ones wait for the next
/// tick.
inline constexpr std::size_t kMaxTickBytes = 1024;
inline constexpr std::size_t kEveryByte = std::numeric_limits<std::size_t>::max();
/// A cell in which nothing is due for longer looks at its time nevertheless.
inline constexpr Tick kMaxSleep = Tick{3600} * kTickHz;

/// Advances time to `target`, or to the end of the tick with the last of `max_bytes` bytes if
/// another byte is due after it. Returns the number of bytes.
std::size_t advance(CellState& cell, Tick target, CellOutput& out,
                    std::size_t max_bytes = kEveryByte);
/// Advances time until nothing moves and no byte is due, but not beyond `limit`.
void run_to_rest(CellState& cell, Tick limit, CellOutput& out);
/// Advances the machine alone, when no byte is due until then.
void simulate(CellState& cell, Tick target, CellOutput& out);

/// The tick at which the next byte of a line is due; nullopt: none is.
std::optional<Tick> next_due(const CellState& cell);
/// The tick at which the owner must advance time without any input: a byte is due, or a fault
/// begins or ends. At most kMaxSleep ahead; nullopt if there is none.
std::optional<Tick> next_wake(const CellState& cell);

/// Enters what is due on a line into the agenda, after the line has changed.
void schedule(CellState& cell, const SerialLine& line);
void schedule_all(CellState& cell);

/// Records the bytes that have acted, or left, and are not recorded yet. To be called before a line
/// closes.
void record_acted(CellState& cell, SerialLine& line, CellOutput& out);
void record_departed(CellState& cell, SerialLine& line, CellOutput& out);

}  // namespace xr3
