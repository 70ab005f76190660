#include <string>

#include "cell/advance.hpp"
#include "cell/calls/calls.hpp"

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

call::Outcome carry_out(CellState& cell, const call::SetFault& set, WallNs, CellOutput&) {
  if (cell.device) {
    return call::Refused{"has_device", "faults are for the simulation, and a device is connected",
                         "start the server without --serial to set faults"};
  }
  const Fault& fault = set.fault;
  if (fault.joint != 0 && cell.model().index_of(fault.joint) < 0) {
    return call::Refused{"no_such_joint", "this robot has no joint " + std::string(1, fault.joint),
                         "its labels are " + cell.model().labels()};
  }
  const bool is_new = find_fault(cell.state(), fault.name) == nullptr;
  if (is_new && cell.state().faults.all.size() >= kMaxFaults) {
    return call::Refused{"limit", "there are " + std::to_string(kMaxFaults) + " faults already",
                         "call fault_clear, or use the name of one of them"};
  }
  if (set.seed) cell.machine.edit().faults.seed = *set.seed;
  cell.machine.set_fault(fault);
  schedule_all(cell);
  return call::Done{};
}

call::Outcome carry_out(CellState& cell, const call::ClearFault& clear, WallNs, CellOutput&) {
  const bool was_there = cell.machine.clear_faults(clear.name);
  if (!was_there && !clear.name.empty()) return no_such_fault(cell.state(), clear.name);
  schedule_all(cell);
  return call::Done{};
}

}  // namespace xr3
