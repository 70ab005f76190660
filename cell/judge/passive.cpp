#include "cell/judge/passive.hpp"

#include "cell/cell.hpp"
#include "cell/judge/run_observer.hpp"
#include "protocol/goals/judge.hpp"

namespace xr3 {

std::vector<bool> passive_goals(const GoalList& goals, const ModelPtr& model,
                                const std::optional<FaultPlan>& faults) {
  Cell cell("passive", model, SimClock::manual());
  if (faults) cell.set_faults(*faults);
  const RunObserver observer(cell, goals);
  cell.apply(Input{call::Call{call::RunUntil{std::nullopt, kRestLimit}}}, 0);
  std::vector<bool> passive;
  for (const GoalResult& each : judge(goals, cell.model(), cell.state(), observer.facts()))
    passive.push_back(each.is_met);
  return passive;
}

}  // namespace xr3
