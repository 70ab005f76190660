// Faults on demand: those of the start, and the calls that set and clear them.
#include <cassert>
#include <string>
#include <utility>

#include "cell/cell.hpp"

namespace xr3 {
namespace {

call::Refused no_such_fault(const State& state, const std::string& name) {
  std::string names;
  for (const FaultState& each : state.faults.all)
    names += (names.empty() ? "" : ", ") + each.fault.name;
  return {"no_such_fault", "there is no fault " + name,
          names.empty() ? "there are no faults; fault_set adds one" : "the faults are " + names};
}

}  // namespace

void Cell::set_faults(FaultPlan plan) {
  assert(lines_.empty() && plan.faults.size() <= kMaxFaults);
  initial_faults_ = std::move(plan);
  simulation_.install_faults(initial_faults_);
  emit_time_events();
}

void Cell::emit_fault_events(LineId id, SerialLine& line) {
  for (Event& event : line.take_fault_events()) {
    emit_all(id, warnings_.finish(id, event.tick));
    emit_at(event.tick, id, std::move(event.body));
  }
}

/// Cuts the lines that a fault disconnects at a tick.
void Cell::note_fault(const EventBody& event) {
  const auto* news = std::get_if<FaultNews>(&event);
  const bool is_cut = news != nullptr && news->kind == FaultKind::kLineDisconnected &&
                      news->phase == FaultPhase::kEffect;
  if (!is_cut) return;
  for (auto& [id, line] : lines_) {
    if (news->line != 0 && news->line != id) continue;
    line.cut();
    schedule(id, line);
    woken_.push_back(id);
  }
}

call::Outcome Cell::carry_out(const call::SetFault& set, WallNs) {
  if (device_) {
    return call::Refused{"has_device", "faults are for the simulation, and a device is connected",
                         "start the server without --serial to set faults"};
  }
  const Fault& fault = set.fault;
  if (fault.joint != 0 && model().index_of(fault.joint) < 0) {
    return call::Refused{"no_such_joint", "this robot has no joint " + std::string(1, fault.joint),
                         "its labels are " + model().labels()};
  }
  const bool is_new = find_fault(state(), fault.name) == nullptr;
  if (is_new && state().faults.all.size() >= kMaxFaults) {
    return call::Refused{"limit", "there are " + std::to_string(kMaxFaults) + " faults already",
                         "call fault_clear, or use the name of one of them"};
  }
  if (set.seed) simulation_.edit().faults.seed = *set.seed;
  simulation_.set_fault(fault);
  schedule_all();
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::ClearFault& clear, WallNs) {
  const bool was_there = simulation_.clear_faults(clear.name);
  if (!was_there && !clear.name.empty()) return no_such_fault(state(), clear.name);
  schedule_all();
  return call::Done{};
}

}  // namespace xr3
