#include "cell/advance.hpp"

#include <algorithm>

#include "cell/events.hpp"
#include "cell/receive.hpp"
#include "cell/reply.hpp"

namespace xr3 {
namespace {

std::optional<Tick> next_due_until(const CellState& cell, Tick limit) {
  const std::optional<Tick> due = next_due(cell);
  return due && *due <= limit ? due : std::nullopt;
}

/// A tick has passed for those who see each.
void end_tick(CellState& cell, CellOutput& out) {
  if (!cell.machine.events().empty()) emit_machine_events(cell, cell.machine.take_events(), out);
  out.hand_over();
  out.on_tick();
}

/// Advances the machine until nothing moves, but not beyond `limit`.
void simulate_to_rest(CellState& cell, Tick limit, CellOutput& out) {
  if (!out.on_tick) return cell.machine.run_to_rest(limit);
  while (cell.tick() < limit && !cell.machine.is_at_rest()) {
    cell.machine.advance_to(cell.tick() + 1);
    end_tick(cell, out);
  }
}

// A command is one record, with the bytes before it that did nothing, and so is what has arrived of
// an unfinished one.
void act_input(CellState& cell, SerialLine& line, Micros now, CellOutput& out) {
  if (!line.acted().is_followed_by(line.next_offset())) record_acted(cell, line, out);
  act(cell, line, line.take_due(), now, out);
  line.update_input_halt(now);
  emit_fault_events(cell, line, out);
  const bool is_last = line.input_under_way() == 0;
  if (!out.talk.exchanges.empty() || is_last || line.acted().bytes.size() >= kMaxShownIn)
    record_acted(cell, line, out);
  emit_exchanges(cell, line, out);
  if (is_last) emit_all(cell, line.id(), cell.warnings.finish(line.id(), cell.tick()), out);
  const bool has_room = line.input_under_way() == LinePace::kMaxInput / 2;
  if (has_room || line.is_drained()) out.woken.push_back(line.id());
}

/// Whether a reply that a fault has held back may leave now.
bool is_released(const CellState& cell, const SerialLine& line) {
  const LineFaults* faults = line.faults();
  const std::optional<Tick> due = faults == nullptr ? std::nullopt : faults->due(cell.state());
  return due && *due <= cell.tick();
}

/// Executes or sends the earliest byte. The reply to one that had to wait for this tick does not
/// leave before it. Returns false if a fault has made the byte due later.
bool act_due(CellState& cell, CellOutput& out) {
  const Due due = cell.agenda.first();
  const bool has_waited = first_tick_after(due.at) < cell.tick();
  const Micros now = has_waited ? micros_at(cell.tick()) : due.at;
  SerialLine& line = *cell.find_line(due.line);
  out.talk.clear();
  bool has_acted = true;
  if (due.direction == Direction::kIn) {
    act_input(cell, line, now, out);
  } else if (is_released(cell, line)) {
    release(cell, line, now, out);
  } else if (const auto at = line.due(Direction::kOut); at && *at <= due.at) {
    send_due(cell, line, now, out);
  } else {
    has_acted = false;
  }
  if (has_acted) cell.due_bytes.add(cell.tick());
  schedule(cell, line);
  return has_acted;
}

}  // namespace

std::optional<Tick> next_due(const CellState& cell) {
  if (cell.agenda.empty()) return std::nullopt;
  const Tick due = first_tick_after(cell.agenda.first().at);
  const bool is_full =
      cell.clock.mode() == ClockMode::kReal && cell.due_bytes.count >= kMaxTickBytes;
  return is_full ? std::max(due, cell.due_bytes.tick + 1) : due;
}

std::optional<Tick> next_wake(const CellState& cell) {
  const std::optional<Tick> due = next_due(cell);
  const Tick stop = cell.state().faults.now.next_stop;
  if (stop == kNoTick) return due;
  const Tick wake = std::min(stop, cell.tick() + kMaxSleep);
  return due ? std::min(*due, wake) : wake;
}

std::size_t advance(CellState& cell, Tick target, CellOutput& out, std::size_t max_bytes) {
  std::size_t count = 0;
  while (const std::optional<Tick> due = next_due_until(cell, target)) {
    if (count >= max_bytes && *due > cell.tick()) return count;
    if (*due > cell.tick()) out.hand_over_if_large();  // what belongs to a tick stays together
    simulate(cell, *due, out);
    emit_time_events(cell, out);
    if (next_due(cell) != due) continue;  // a fault has cut the line
    if (act_due(cell, out)) ++count;
  }
  simulate(cell, target, out);
  return count;
}

void run_to_rest(CellState& cell, Tick limit, CellOutput& out) {
  while (const std::optional<Tick> due = next_due_until(cell, limit)) advance(cell, *due, out);
  if (cell.agenda.empty()) return simulate_to_rest(cell, limit, out);
  simulate(cell, limit, out);  // a byte is due after the limit
}

void simulate(CellState& cell, Tick target, CellOutput& out) {
  if (!out.on_tick) return cell.machine.advance_to(target);
  simulate_to_rest(cell, target, out);
  if (cell.tick() >= target) return;
  cell.machine.advance_to(target);
  end_tick(cell, out);
}

void schedule(CellState& cell, const SerialLine& line) {
  if (!cell.line_speed && cell.agenda.empty() && !line.holds_replies()) return;
  cell.agenda.set(line.id(), Direction::kIn, line.due(Direction::kIn));
  cell.agenda.set(line.id(), Direction::kOut, line.next_reply(cell.state()));
}

void schedule_all(CellState& cell) {
  for (const auto& [id, line] : cell.lines) schedule(cell, line);
}

void record_acted(CellState& cell, SerialLine& line, CellOutput& out) {
  ByteRun& run = line.acted();
  if (run.empty()) return;
  fill_in(out.add_record(), {cell.epoch, cell.tick(), line.id(), run.from}, run.bytes, std::nullopt,
          out.talk.exchanges, cell.machine);
  run.bytes.clear();
}

void record_departed(CellState& cell, SerialLine& line, CellOutput& out) {
  ByteRun& run = line.departed();
  if (run.empty()) return;
  fill_out(out.add_record(), {cell.epoch, cell.tick(), line.id(), run.from}, run.bytes,
           out.talk.replies);
  run.bytes.clear();
}

}  // namespace xr3
