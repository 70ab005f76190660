#include "cell/byte_time.hpp"

#include <algorithm>
#include <utility>

#include "cell/advance.hpp"
#include "cell/events.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3 {
namespace {

/// Whether the moment of this end is not decided by the client's bytes.
bool is_aborted(LineCloseReason reason) {
  return reason == LineCloseReason::kError || reason == LineCloseReason::kMemory ||
         reason == LineCloseReason::kDisconnected;
}

Micros character_time(const CellState& cell, const SerialLine& line) {
  const ByteClock& clock = *cell.byte_clock;
  return clock.character_time(clock.follows_clients() ? line.settings() : std::nullopt);
}

Tick sum(Tick start, Tick ticks) { return std::min(start + ticks, monitor::kMaxInteger); }

/// Synchronizes events, clock and counters after bytes have moved time from `start`.
void after_bytes(CellState& cell, Tick start, CellOutput& out) {
  emit_time_events(cell, out);
  cell.clock.set_tick(cell.tick(), 0);
  cell.counters.ticks += static_cast<std::uint64_t>(cell.tick() - start);
}

/// Time passes, as long as the byte clock says.
void pass(CellState& cell, Micros time, CellOutput& out) {
  const Tick ticks = cell.byte_clock->take_ticks(time);
  if (ticks == 0) return;
  const Tick start = cell.tick();
  simulate(cell, sum(start, ticks), out);
  after_bytes(cell, start, out);
}

/// Reports what the line has done so far, and lets pass the time that its replies take.
void pass_before(CellState& cell, SerialLine& line, Micros time, CellOutput& out) {
  emit_exchanges(cell, line, out);
  pass(cell, cell.byte_clock->take_owed() + time, out);
}

/// Reports a command that does not wait for the motion before, once in a run of such commands.
void note_hurry(CellState& cell, SerialLine& line, const Command& command, CellOutput& out) {
  if (!cell.byte_clock->note_command(command, cell.model(), cell.state())) return;
  line.note_warning();
  ProblemNote note =
      hurry_note(std::holds_alternative<Move>(command) ? std::get<Move>(command).label
                                                       : std::get<Stop>(command).label);
  ++cell.counters.warnings[note.code];
  emit_all(cell, line.id(), cell.warnings.add(line.id(), cell.tick(), std::move(note)), out);
}

}  // namespace

// --- Turns.

std::optional<LineId> current_line(const CellState& cell) {
  const bool has_turns = cell.byte_clock && !cell.byte_clock->settings().has_concurrent_lines;
  if (!has_turns || cell.lines.empty()) return std::nullopt;
  return cell.lines.begin()->first;
}

std::optional<LineId> line_before(const CellState& cell, LineId line) {
  const std::optional<LineId> current = current_line(cell);
  if (!current || current == line) return std::nullopt;
  return cell.lines.contains(line) ? current : std::nullopt;
}

void end_turn(CellState& cell, LineCloseReason reason, CellOutput& out) {
  if (!cell.byte_clock || reason == LineCloseReason::kShutdown) return;
  if (cell.is_moved_by_bytes()) rest(cell, out);
  const std::optional<LineId> next = current_line(cell);
  if (!next) return;
  emit(cell, *next, LineTurnNote{}, out);
  out.woken.push_back(*next);
}

// --- Time.

bool pass_character(CellState& cell, SerialLine& line, std::uint8_t byte, CellOutput& out) {
  if (!cell.transcript) return true;
  if (cell.is_moved_by_bytes()) pass_before(cell, line, character_time(cell, line), out);
  if (line.is_cut()) return false;
  cell.transcript->add_in(line.id(), cell.tick(), byte);
  return true;
}

bool pass_command(CellState& cell, SerialLine& line, const Command& command, CellOutput& out) {
  if (!cell.transcript) return true;
  if (cell.is_moved_by_bytes()) {
    if (is_inquiry(command)) pass_before(cell, line, cell.byte_clock->inquiry_time(), out);
    note_hurry(cell, line, command, out);
  }
  return !line.is_cut();
}

void pass_delays(CellState& cell, CellOutput& out) {
  if (!cell.is_moved_by_bytes()) return;
  for (;;) {
    pass(cell, cell.byte_clock->take_owed(), out);
    const std::optional<Tick> due = next_due(cell);
    if (!due) return;
    const Tick start = cell.tick();
    advance(cell, std::max(*due, start), out);
    after_bytes(cell, start, out);
  }
}

void rest(CellState& cell, CellOutput& out) {
  pass_delays(cell, out);
  const Tick start = cell.tick();
  run_to_rest(cell, sum(start, kMaxSleep), out);
  after_bytes(cell, start, out);
}

std::optional<SerialSettings> speed_of(const CellState& cell, const SerialLine& line) {
  return cell.byte_clock ? cell.byte_clock->settings_of(line.settings()) : line.speed();
}

// --- The transcript.

void note_reply(CellState& cell, const SerialLine& line, std::string_view reply) {
  if (!cell.transcript) return;
  cell.transcript->add_out(line.id(), cell.tick(), reply);
  if (cell.is_moved_by_bytes())
    cell.byte_clock->owe(static_cast<Micros>(reply.size()) * character_time(cell, line));
}

void mark(CellState& cell, TranscriptMark mark) {
  if (cell.transcript) cell.transcript->mark(mark);
}

void note_end(CellState& cell, LineId line, LineCloseReason reason) {
  if (!cell.transcript) return;
  cell.transcript->end_line(line);
  if (is_aborted(reason)) mark(cell, TranscriptMark::kNotBytesAlone);
}

// Which bytes have acted before depends on time.
void note_settings(CellState& cell, const SerialLine& line, const SerialSettings& reported) {
  const bool is_late =
      cell.byte_clock && cell.byte_clock->follows_clients() && line.bytes_acted() > 0;
  if (is_late && line.settings() != reported) mark(cell, TranscriptMark::kNotBytesAlone);
}

// How many bytes of the open lines acted before the new epoch depends on wall time, so its
// transcript is not a function of the bytes alone.
void restart_bytes(CellState& cell) {
  if (cell.byte_clock) cell.byte_clock->restart();
  if (!cell.transcript) return;
  cell.transcript->restart();
  if (cell.byte_clock && cell.byte_clock->settings().has_concurrent_lines)
    mark(cell, TranscriptMark::kArrivalOrder);
  if (!cell.lines.empty()) mark(cell, TranscriptMark::kNotBytesAlone);
}

}  // namespace xr3
