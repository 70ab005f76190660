#include "cell/calls/calls.hpp"
#include "cell/epoch.hpp"
#include "cell/events.hpp"

namespace xr3 {

call::Outcome carry_out(CellState& cell, const call::Reset&, WallNs now, CellOutput& out) {
  begin_epoch(
      cell, "reset", now,
      [&cell] {
        cell.machine.reset();
        cell.machine.install_faults(cell.initial_faults);
        for (auto& [id, line] : cell.lines) line.reset();
      },
      out);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::Home&, WallNs, CellOutput&) {
  cell.machine.execute(SoftHome{});
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::Key& key, WallNs, CellOutput&) {
  const bool was_enabled = cell.state().enabled;
  cell.machine.execute(key.command);
  if (cell.device && cell.state().enabled != was_enabled) cell.device->engage(was_enabled);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::SetInput& input, WallNs, CellOutput&) {
  cell.machine.set_input(input.input, input.value);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::SayNotice& notice, WallNs, CellOutput& out) {
  emit(cell, std::nullopt, NoticeNote{notice.text}, out);
  return call::Done{};
}

}  // namespace xr3
