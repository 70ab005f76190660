// Bytes of the lines that take time: they are executed, or leave, when they are due.
#include <algorithm>
#include <cassert>

#include "cell/cell.hpp"

namespace xr3 {

void Cell::set_line_speed(const LineSpeed& speed) {
  assert(lines_.empty() && !device_);
  line_speed_ = speed;
}

std::optional<Tick> Cell::next_due() const {
  if (agenda_.empty()) return std::nullopt;
  const Tick due = first_tick_after(agenda_.first().at);
  const bool is_full = clock_.mode() == ClockMode::kReal && due_bytes_.count >= kMaxTickBytes;
  return is_full ? std::max(due, due_bytes_.tick + 1) : due;
}

std::optional<Tick> Cell::next_due_until(Tick limit) const {
  const std::optional<Tick> due = next_due();
  return due && *due <= limit ? due : std::nullopt;
}

/// Advances time to `target`, or to the end of the tick with the last of `max_bytes` bytes if
/// another byte is due after it. Returns the number of bytes.
std::size_t Cell::advance_to(Tick target, std::size_t max_bytes) {
  std::size_t count = 0;
  while (const std::optional<Tick> due = next_due_until(target)) {
    if (count >= max_bytes && *due > state().tick) return count;
    simulate_to(*due);
    emit_time_events();
    if (next_due() != due) continue;  // a fault has cut the line
    if (act_due()) ++count;
  }
  simulate_to(target);
  return count;
}

/// Advances time until nothing moves and no byte is due, but not beyond `limit`.
void Cell::run_to_rest(Tick limit) {
  while (const std::optional<Tick> due = next_due_until(limit)) advance_to(*due);
  if (agenda_.empty()) return simulate_to_rest(limit);
  simulate_to(limit);  // a byte is due after the limit
}

/// Advances the machine; a watcher sees each tick in which something may move.
void Cell::simulate_to(Tick target) {
  if (watchers_.empty()) return simulation_.advance_to(target);
  simulate_to_rest(target);
  if (state().tick >= target) return;
  simulation_.advance_to(target);
  for (CellWatcher* watcher : watchers_) watcher->after_tick(*this);
}

/// Advances the machine until nothing moves, but not beyond `limit`.
void Cell::simulate_to_rest(Tick limit) {
  if (watchers_.empty()) return simulation_.run_to_rest(limit);
  while (state().tick < limit && !simulation_.is_at_rest()) {
    simulation_.advance_to(state().tick + 1);
    for (CellWatcher* watcher : watchers_) watcher->after_tick(*this);
  }
}

/// Executes or sends the earliest byte. The reply to one that had to wait for this tick does not
/// leave before it. Returns false if a fault has made the byte due later.
bool Cell::act_due() {
  const Due due = agenda_.first();
  const bool has_waited = first_tick_after(due.at) < state().tick;
  const Micros now = has_waited ? micros_at(state().tick) : due.at;
  SerialLine& line = *open_line(due.line);
  exchanges_.clear();
  bool has_acted = true;
  if (due.direction == Direction::kIn) {
    act_input(due.line, line, now);
  } else if (line.is_reply_released(state())) {
    release_replies(due.line, line, now);
  } else if (const auto at = line.due(Direction::kOut); at && *at <= due.at) {
    send_reply(due.line, line, now);
  } else {
    has_acted = false;
  }
  if (has_acted) due_bytes_.add(state().tick);
  schedule(due.line, line);
  return has_acted;
}

// A command is one record, with the bytes before it that did nothing, and so is what has arrived of
// an unfinished one.
void Cell::act_input(LineId id, SerialLine& line, Micros now) {
  if (!line.acted().is_followed_by(line.next_offset())) record_acted(id, line);
  line.act_due(now, simulation_, exchanges_);
  if (line.has_fault_events()) emit_fault_events(id, line);
  const bool is_last = line.input_under_way() == 0;
  if (!exchanges_.empty() || is_last || line.acted().bytes.size() >= kMaxShownIn)
    record_acted(id, line);
  emit_exchanges(id, line);
  if (is_last) emit_all(id, warnings_.finish(id, state().tick));
  const bool has_room = line.input_under_way() == LinePace::kMaxInput / 2;
  if (has_room || line.is_drained()) woken_.push_back(id);
}

void Cell::send_reply(LineId id, SerialLine& line, Micros now) {
  if (!line.departed().is_followed_by(line.output_end())) record_departed(id, line);
  const std::size_t unsent = line.outbox().size();
  line.send_due(now);
  ++counters_.bytes_out;
  for (InputLog* log : logs_) log->output(*this, id, line.outbox().substr(unsent));
  if (!line.released().empty() || line.departed().bytes.size() >= kMaxShownOut)
    record_departed(id, line);
  woken_.push_back(id);
}

void Cell::record_acted(LineId id, SerialLine& line) {
  ByteRun& run = line.acted();
  if (run.empty()) return;
  fill_in(wires_.push(), {epoch_, state().tick, id, run.from}, run.bytes, std::nullopt, exchanges_,
          simulation_);
  run.bytes.clear();
}

void Cell::record_departed(LineId id, SerialLine& line) {
  ByteRun& run = line.departed();
  if (run.empty()) return;
  fill_out(wires_.push(), {epoch_, state().tick, id, run.from}, run.bytes, {}, line.released());
  run.bytes.clear();
}

/// Replies that a fault has held back leave, at the speed of the line.
void Cell::release_replies(LineId id, SerialLine& line, Micros now) {
  record_departed(id, line);
  const WirePlace out{epoch_, state().tick, id, line.output_end()};
  const std::size_t unsent = line.outbox().size();
  exchanges_.clear();
  line.release_replies(state(), now);
  record_out(out, line, unsent);
  woken_.push_back(id);
}

void Cell::schedule(LineId id, const SerialLine& line) {
  if (!line_speed_ && agenda_.empty() && !line.holds_replies()) return;
  agenda_.set(id, Direction::kIn, line.due(Direction::kIn));
  agenda_.set(id, Direction::kOut, line.next_reply(state()));
}

void Cell::schedule_all() {
  for (const auto& [id, line] : lines_) schedule(id, line);
}

std::optional<Tick> Cell::next_wake() const {
  const std::optional<Tick> due = next_due();
  const Tick stop = state().faults.now.next_stop;
  if (stop == kNoTick) return due;
  const Tick wake = std::min(stop, state().tick + kMaxSleep);
  return due ? std::min(*due, wake) : wake;
}

/// Time has jumped: the bytes under way are due in the new epoch.
void Cell::restart_lines() {
  due_bytes_ = {};
  for (auto& [id, line] : lines_) {
    line.restart(micros_at(state().tick));
    schedule(id, line);
  }
}

}  // namespace xr3
