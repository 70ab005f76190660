#include <algorithm>
#include <string>

#include "cell/advance.hpp"
#include "cell/calls/calls.hpp"
#include "cell/epoch.hpp"
#include "cell/events.hpp"

namespace xr3 {
namespace {

call::Refused clock_running(std::string_view call) {
  return {"clock_running", std::string(call) + " needs the manual clock; the clock is real",
          "call pause first, or start with --clock manual"};
}

call::Refused has_device() {
  return {"has_device", "time cannot be changed while a device is connected",
          "start the server without --serial to control time"};
}

call::Refused frozen() {
  return {"frozen", "time stands: this robot is frozen for a lesson",
          "wait until the holder of the server's token calls unfreeze"};
}

void note_clock(CellState& cell, std::string_view call, CellOutput& out) {
  emit(cell, std::nullopt, ClockNote{call, cell.clock.mode(), cell.clock.rate()}, out);
}

/// Synchronizes the clock and the counters after the manual clock advanced from `start`.
void after_manual_advance(CellState& cell, Tick start, WallNs now) {
  cell.clock.set_tick(cell.tick(), now);
  cell.counters.ticks += static_cast<std::uint64_t>(cell.tick() - start);
}

}  // namespace

call::Outcome carry_out(CellState& cell, const call::Pause&, WallNs now, CellOutput& out) {
  if (cell.device) return has_device();
  const bool is_new = cell.clock.mode() != ClockMode::kManual;
  cell.clock.pause(now);
  if (is_new) note_clock(cell, "pause", out);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::Freeze&, WallNs now, CellOutput& out) {
  if (cell.device) return has_device();
  if (cell.frozen) return call::Done{};
  const bool is_manual = cell.clock.mode() == ClockMode::kManual;
  cell.frozen = Frozen{cell.in_past ? cell.in_past->was_manual : is_manual};
  cell.clock.pause(now);
  note_clock(cell, "freeze", out);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::Unfreeze&, WallNs now, CellOutput& out) {
  if (!cell.frozen) return call::Done{};
  const Frozen before = *cell.frozen;
  cell.frozen.reset();
  if (cell.in_past) {
    cell.in_past->was_manual = before.was_manual;
  } else if (!before.was_manual) {
    cell.clock.resume(now);
  }
  note_clock(cell, "unfreeze", out);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::Resume&, WallNs now, CellOutput& out) {
  if (cell.frozen) return frozen();
  const bool stays_manual = cell.in_past && cell.in_past->was_manual;
  end_past(cell, out);
  if (stays_manual) return call::Done{};
  const bool is_new = cell.clock.mode() != cell.clock.running_mode();
  cell.clock.resume(now);
  if (is_new) note_clock(cell, "resume", out);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::SetRate& rate, WallNs now, CellOutput& out) {
  if (cell.device) return has_device();
  if (cell.clock.running_mode() == ClockMode::kBytes) {
    return call::Refused{"no_rate",
                         "the byte clock has no rate: time moves with the bytes of the lines",
                         "start with --clock real to set a rate"};
  }
  cell.clock.set_rate(rate.rate, now);
  note_clock(cell, "rate", out);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::Step& step, WallNs now, CellOutput& out) {
  if (cell.frozen) return frozen();
  if (cell.clock.mode() == ClockMode::kReal) return clock_running("step");
  const Tick start = cell.tick();
  advance(cell, start + step.ticks, out);
  after_manual_advance(cell, start, now);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::RunUntil& run, WallNs now, CellOutput& out) {
  if (cell.frozen) return frozen();
  if (cell.clock.mode() == ClockMode::kReal) return clock_running("run_until");
  const Tick start = cell.tick();
  const Tick limit = start + run.max_ticks;
  if (run.tick) {
    advance(cell, std::min(limit, *run.tick), out);
  } else {
    run_to_rest(cell, limit, out);
  }
  after_manual_advance(cell, start, now);
  const bool reached = run.tick ? cell.tick() >= *run.tick : cell.is_at_rest();
  return call::Done{reached, cell.tick() - start, nullptr};
}

}  // namespace xr3
