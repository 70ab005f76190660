#include "core/faults/faults.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/faults/chance.hpp"
#include "core/home.hpp"
#include "core/switches.hpp"

namespace xr3 {
namespace {

bool lasts(const Fault& fault) { return traits_of(fault.kind).manner == FaultManner::kLasting; }

/// Whether the fault has its effect at its first tick, without an occasion.
bool is_timed(const Fault& fault) {
  return traits_of(fault.kind).manner == FaultManner::kOnce ||
         (fault.kind == FaultKind::kLineDisconnected && fault.at_tick);
}

void add_stop(FaultsInForce& now, Tick tick, Tick stop) {
  if (stop > tick) now.next_stop = std::min(now.next_stop, stop);
}

void add_speed_percent(FaultsInForce& now, const FaultState& fault, int motor,
                       std::uint8_t percent) {
  auto& least = now.speed_percent[static_cast<std::size_t>(motor)];
  least = std::min(least, percent);
  if (percent == 0 && fault.fault.end() == kNoTick) now.stuck_for_good |= bit_of(motor);
}

void add_lasting(FaultsInForce& now, const FaultState& fault, int motor) {
  switch (fault.fault.kind) {
    case FaultKind::kMotorStuck: return add_speed_percent(now, fault, motor, 0);
    case FaultKind::kMotorSlow:
      return add_speed_percent(now, fault, motor, static_cast<std::uint8_t>(fault.fault.percent));
    case FaultKind::kSwitchStuckOpen: now.open |= bit_of(motor); break;
    case FaultKind::kSwitchStuckClosed: now.closed |= bit_of(motor); break;
    case FaultKind::kSwitchBouncing: now.bouncing |= bit_of(motor); break;
    case FaultKind::kCameraNoise:
    case FaultKind::kCameraDeadRow:
    case FaultKind::kCameraOffset: now.on_camera = true; break;
    default: break;
  }
}

void add_to(FaultsInForce& now, const Model& model, const FaultState& each, Tick tick) {
  const Fault& fault = each.fault;
  const int motor = fault.joint != 0 ? model.index_of(fault.joint) : model.tool_index();
  assert(motor >= 0);
  if (lasts(fault) || (is_timed(fault) && !each.is_spent())) {
    add_stop(now, tick, fault.begin());
    add_stop(now, tick, fault.end());
  }
  now.on_lines |= traits_of(fault.kind).target == FaultTarget::kLine;
  if (each.is_on) add_lasting(now, each, motor);
  if (each.is_spent()) return;
  if (fault.kind == FaultKind::kEncoderSlip) now.slipping |= bit_of(motor);
  now.on_grip |= fault.kind == FaultKind::kGripSlip;
}

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

void refresh_faults(const Model& model, State& state) {
  Faults& faults = state.faults;
  faults.now = {};
  for (FaultState& each : faults.all) {
    each.salt = salt_of(faults.seed, each.fault.name);
    each.is_on = lasts(each.fault) && each.fault.covers(state.tick);
    add_to(faults.now, model, each, state.tick);
  }
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

void add_effect(const Model& model, State& state, FaultState& fault, char label, std::int64_t at,
                Events& events) {
  ++fault.effects;
  if (fault.is_spent()) refresh_faults(model, state);
  const Tick second = state.tick / kTickHz;
  if (std::exchange(fault.news_second, second) != second) fault.news = 0;
  if (fault.news >= kMaxFaultNews) return;
  ++fault.news;
  const bool is_timed_cut = fault.fault.kind == FaultKind::kLineDisconnected && fault.fault.at_tick;
  events.push_back(
      {state.tick, FaultNews{fault.fault.name, fault.fault.kind, FaultPhase::kEffect, fault.effects,
                             label, at, is_timed_cut ? fault.fault.line : 0}});
}

bool acts_on(const State& state, const FaultState& fault, std::uint64_t first,
             std::uint64_t second) {
  if (fault.is_spent() || !fault.fault.covers(state.tick)) return false;
  if (!fault.fault.chance) return true;
  return happens(chance_hash(fault.salt, first, second), *fault.fault.chance);
}

}  // namespace xr3
