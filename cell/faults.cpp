#include "cell/faults.hpp"

#include "cell/advance.hpp"

namespace xr3 {

void cut_lines(CellState& cell, const EventBody& event, CellOutput& out) {
  const auto* news = std::get_if<FaultNews>(&event);
  const bool is_cut = news != nullptr && news->kind == FaultKind::kLineDisconnected &&
                      news->phase == FaultPhase::kEffect;
  if (!is_cut) return;
  for (auto& [id, line] : cell.lines) {
    if (news->line != 0 && news->line != id) continue;
    line.cut();
    schedule(cell, line);
    out.woken.push_back(id);
  }
}

}  // namespace xr3
