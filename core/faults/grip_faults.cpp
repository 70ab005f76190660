#include "core/faults/grip_faults.hpp"

#include "core/faults/faults.hpp"
#include "core/grasp.hpp"

namespace xr3 {

void slip_grip(const Model& model, State& state, const Positions& positions, Events& events) {
  if (!state.faults.now.on_grip || !state.held) return;
  const char label = model.motor(model.tool_index()).drive.label;
  const auto tick = static_cast<std::uint64_t>(state.tick);
  for (FaultState& each : state.faults.all) {
    if (each.fault.kind != FaultKind::kGripSlip) continue;
    if (!acts_on(state, each, static_cast<std::uint64_t>(label), tick)) continue;
    Events fallen;
    if (!drop(model, state, positions, fallen)) return;
    add_effect(model, state, each, label, state.motor(model.tool_index()).count, events);
    events.insert(events.end(), fallen.begin(), fallen.end());
    return;
  }
}

}  // namespace xr3
