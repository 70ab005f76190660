#include "core/faults/motor_faults.hpp"

#include "core/faults/chance.hpp"
#include "core/faults/effects.hpp"
#include "core/grasp.hpp"

namespace xr3 {
namespace {

bool is_of(const FaultState& each, FaultKind kind, char label) {
  return each.fault.kind == kind && each.fault.joint == label;
}

bool is_bouncing(const FaultState& each, char label, Tick tick) {
  return is_of(each, FaultKind::kSwitchBouncing, label) && each.is_on && each.bounce_tick &&
         tick - *each.bounce_tick < each.fault.bounce_ms;
}

}  // namespace

bool loses_count(const Model& model, State& state, int motor, Events& events) {
  Faults& faults = state.faults;
  if (!may_lose_count(state, motor)) return false;
  const MotorBits bit = bit_of(motor);
  const bool was_lost = has_motor(faults.slipped, motor);
  faults.slipped = static_cast<MotorBits>(faults.slipped & ~bit);
  if (was_lost) return false;
  const char label = model.motor(motor).drive.label;
  const auto count = state.motor(motor).count;
  const auto number = static_cast<std::uint64_t>(std::int64_t{count});
  for (FaultState& each : faults.all) {
    if (!is_of(each, FaultKind::kEncoderSlip, label)) continue;
    if (!acts_on(state, each, static_cast<std::uint64_t>(label), number)) continue;
    faults.slipped |= bit;
    add_effect(model, state, each, label, count, events);
    return true;
  }
  return false;
}

void begin_bounce(const Model& model, State& state, int motor, Events& events) {
  if (!has_motor(state.faults.now.bouncing, motor)) return;
  const char label = model.motor(motor).drive.label;
  for (FaultState& each : state.faults.all) {
    if (!each.is_on || !is_of(each, FaultKind::kSwitchBouncing, label)) continue;
    each.bounce_tick = state.tick;
    add_effect(model, state, each, label, state.motor(motor).count, events);
  }
}

bool reads_closed(const Model& model, const State& state, int motor) {
  bool closed = state.motor(motor).switch_closed;
  if (!has_motor(state.faults.now.bouncing, motor)) return closed;
  const char label = model.motor(motor).drive.label;
  for (const FaultState& each : state.faults.all) {
    if (!is_bouncing(each, label, state.tick)) continue;
    const auto tick = static_cast<std::uint64_t>(state.tick);
    closed ^= (chance_hash(each.salt, static_cast<std::uint64_t>(label), tick) & 1U) != 0;
  }
  return closed;
}

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
