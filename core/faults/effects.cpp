#include "core/faults/effects.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/faults/chance.hpp"

namespace xr3 {
namespace {

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

}  // namespace

void refresh_faults(const Model& model, State& state) {
  Faults& faults = state.faults;
  faults.now = {};
  for (FaultState& each : faults.all) {
    each.salt = salt_of(faults.seed, each.fault.name);
    each.is_on = lasts(each.fault) && each.fault.covers(state.tick);
    add_to(faults.now, model, each, state.tick);
  }
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
