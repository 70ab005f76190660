#include "cell/epoch.hpp"

#include <algorithm>
#include <cassert>

#include "cell/advance.hpp"
#include "cell/byte_time.hpp"
#include "cell/calls/calls.hpp"
#include "cell/events.hpp"

namespace xr3 {
namespace {

/// Whether the blocks are equal except for their positions.
bool are_same_things(const SharedVector<Block>& a, const SharedVector<Block>& b) {
  if (a.is_shared_with(b)) return true;
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Block& x, const Block& y) {
    return x.name == y.name && x.size_um == y.size_um && x.color == y.color;
  });
}

/// Time has jumped: the bytes under way are due in the new epoch.
void restart_lines(CellState& cell) {
  cell.due_bytes = {};
  for (auto& [id, line] : cell.lines) {
    line.restart(micros_at(cell.tick()));
    schedule(cell, line);
    line.begin_epoch(cell.tick());
  }
}

}  // namespace

// The note has the first tick of the new epoch and contains the last tick of the old one.
void begin_epoch(CellState& cell, std::string_view call, WallNs now,
                 const std::function<void()>& change, CellOutput& out) {
  for (const auto& [id, line] : cell.lines) emit_all(cell, id, cell.warnings.forget(id), out);
  const EpochNote note{call, cell.epoch, cell.tick()};
  const ModelPtr old_model = cell.machine.model_ptr();
  const SharedVector<Block> old_blocks = cell.state().blocks;
  change();
  if (cell.is_engaged() && cell.state().enabled) cell.device->engage(false);
  ++cell.epoch;
  cell.last_input_tick.reset();
  cell.clock.set_tick(cell.tick(), now);
  restart_bytes(cell);
  restart_lines(cell);
  if (cell.device) cell.device->begin_epoch(cell.tick());
  emit(cell, std::nullopt, note, out);
  const bool is_same = old_model->workcell() == cell.model().workcell() &&
                       are_same_things(old_blocks, cell.state().blocks);
  if (!is_same) changed_model(cell, call, cell.model().workcell().name, out);
}

void take_back(CellState& cell, const Rewind& rewind, WallNs now, CellOutput& out) {
  assert(!cell.device);
  const bool was_manual = cell.clock.mode() == ClockMode::kManual;
  if (!cell.in_past) cell.in_past = InPast{was_manual};
  carry_out(cell, call::Pause{}, now, out);
  begin_epoch(
      cell, "seek", now,
      [&] {
        cell.machine.restore(rewind.past->model, rewind.past->state);
        for (auto& [id, line] : cell.lines) line.reset();
      },
      out);
}

void end_past(CellState& cell, CellOutput& out) {
  if (!cell.in_past) return;
  cell.in_past.reset();
  for (const auto& [id, line] : cell.lines) out.woken.push_back(id);
}

call::Refused in_the_past() {
  return {"in_the_past", "the robot was taken back to its past, and waits",
          "call resume to go on from here, which drops what came after, or seek another time"};
}

void changed_model(CellState& cell, std::string_view call, const std::string& name,
                   CellOutput& out) {
  emit(cell, std::nullopt, ModelNote{call, name, ++cell.model_rev}, out);
}

}  // namespace xr3
