#include "core/faults/faults.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/faults/effects.hpp"
#include "core/home.hpp"
#include "core/switches.hpp"

namespace xr3 {
namespace {

void emit(const State& state, const FaultState& fault, FaultPhase phase, Events& events) {
  events.push_back({state.tick, FaultNews{fault.fault.name, fault.fault.kind, phase, fault.effects,
                                          fault.fault.joint}});
}

void run_timed(const Model& model, State& state, FaultState& fault, Events& events) {
  add_effect(model, state, fault, 0, 0, events);
  if (fault.fault.kind != FaultKind::kPowerCycle) return;
  ++state.faults.power_cycles;
  reset_controller(model, state, events);
}

/// The fault with a begin that is not before the current tick.
Fault from_now(Fault fault, Tick now) {
  if (fault.at_tick) fault.at_tick = std::max(*fault.at_tick, now);
  if (!fault.at_tick && (fault.from_tick || fault.ticks))
    fault.from_tick = std::max(fault.from_tick.value_or(0), now);
  return fault;
}

}  // namespace

const FaultState* find_fault(const State& state, std::string_view name) {
  const auto& all = state.faults.all;
  const auto found = std::find_if(
      all.begin(), all.end(), [name](const FaultState& each) { return each.fault.name == name; });
  return found == all.end() ? nullptr : &*found;
}

void pass_fault_stop(const Model& model, State& state, Events& events) {
  for (FaultState& each : state.faults.all) {
    const bool is_on = lasts(each.fault) && each.fault.covers(state.tick);
    if (is_on != each.is_on)
      emit(state, each, is_on ? FaultPhase::kBegan : FaultPhase::kEnded, events);
    each.is_on = is_on;
  }
  refresh_faults(model, state);
  update_switches(model, state, events);
  for (FaultState& each : state.faults.all) {
    const bool is_due = is_timed(each.fault) && each.fault.begin() <= state.tick;
    if (is_due && !each.is_spent()) run_timed(model, state, each, events);
  }
}

void install_faults(const Model& model, State& state, const FaultPlan& plan, Events& events) {
  assert(plan.faults.size() <= kMaxFaults);
  state.faults = {};
  state.faults.seed = plan.seed;
  for (const Fault& fault : plan.faults) state.faults.all.push_back({fault});
  pass_fault_stop(model, state, events);
}

void set_fault(const Model& model, State& state, Fault fault, Events& events) {
  auto* place = const_cast<FaultState*>(find_fault(state, fault.name));
  if (place != nullptr && place->is_on) emit(state, *place, FaultPhase::kEnded, events);
  if (place == nullptr) place = &state.faults.all.emplace_back();
  assert(state.faults.all.size() <= kMaxFaults);
  *place = FaultState{from_now(std::move(fault), state.tick)};
  emit(state, *place, FaultPhase::kSet, events);
  pass_fault_stop(model, state, events);
}

bool clear_faults(const Model& model, State& state, std::string_view name, Events& events) {
  bool any = false;
  for (const FaultState& each : state.faults.all) {
    if (!name.empty() && each.fault.name != name) continue;
    emit(state, each, FaultPhase::kCleared, events);
    any = true;
  }
  std::erase_if(state.faults.all,
                [name](const FaultState& each) { return name.empty() || each.fault.name == name; });
  pass_fault_stop(model, state, events);
  return any;
}

}  // namespace xr3
