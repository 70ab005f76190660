#include "core/step.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/carousel.hpp"
#include "core/coupling.hpp"
#include "core/faults/faults.hpp"
#include "core/faults/motor_faults.hpp"
#include "core/grasp.hpp"
#include "core/invariants.hpp"
#include "core/kinematics.hpp"
#include "core/motor.hpp"
#include "core/stall.hpp"
#include "core/switches.hpp"

namespace xr3 {
namespace {

void stall(State& state, const Motors& before, Stall why, Events& events) {
  state.motors = before;
  state.stall = why;
  events.push_back({state.tick, Stalled{why}});
}

bool has_arrived(const State& state, const MotorTickResult& turned, int motor) {
  return has_motor(turned.counted, motor) && state.motor(motor).error == 0;
}

void emit_reached(const Model& model, const State& state, const MotorTickResult& turned,
                  Events& events) {
  for (int i = 0; i < model.motor_count(); ++i) {
    if (!has_arrived(state, turned, i)) continue;
    events.push_back({state.tick, Reached{model.motor(i).drive.label, state.motor(i).count}});
  }
}

// The tick in which a running motor makes its next count, if no fault begins or ends before.
Tick tick_of_count(const State& state, int index) {
  const Tick running = ticks_to_count(state.motor(index));
  const std::uint8_t percent = speed_percent_of(state, index);
  return percent == kFullSpeed ? state.tick + running
                               : tick_after_running(percent, state.tick, running);
}

// Number of ticks, at most `limit`, before some motor makes a count or a fault begins or ends.
Tick quiet_ticks(const Model& model, const State& state, Tick limit) {
  Tick next = std::min(state.tick + limit + 1, state.faults.now.next_stop);
  for (int i = 0; i < model.motor_count(); ++i) {
    if (is_running(state.motor(i))) next = std::min(next, tick_of_count(state, i));
  }
  return next - 1 - state.tick;
}

void coast(const Model& model, State& state, Tick ticks) {
  if (ticks == 0) return;
  const Tick from = std::exchange(state.tick, state.tick + ticks);
  for (int i = 0; i < model.motor_count(); ++i) {
    MotorState& motor = state.motor(i);
    if (!is_running(motor)) continue;
    const std::uint8_t percent = speed_percent_of(state, i);
    const Tick running = percent == kFullSpeed ? ticks : running_ticks(percent, from, state.tick);
    motor.phase = static_cast<std::int16_t>(motor.phase + running * motor.speed);
  }
}

void tick(const Model& model, State& state, Events& events) {
  ++state.tick;
  if (state.tick >= state.faults.now.next_stop) pass_fault_stop(model, state, events);
  if (state.stall != Stall::kNo) return;
  const Motors before = state.motors;
  Positions positions = xr3::positions(model, state.motors);
  const MotorTickResult turned = turn_motors(model, state, positions, events);
  if (!turned.any) return;
  if (turned.joint) {
    const PointUm tip = tool_tip(model, positions);
    if (const Stall why = stall_at(model, state, positions, tip); why != Stall::kNo) {
      return stall(state, before, why, events);
    }
    update_surface(model, state, tip, events);
    if (state.motor(model.tool_index()).error == 0) state.jaws_warned = false;  // closing has ended
    if (!state.display.erase) state.tip_path.add(tip);
  }
  if (turned.table) carry_riders(model, state);
  update_switches(model, state, events, turned.counted);
  update_grasp(model, state, positions, turned.jaws, turned.opened, events);
  if (turned.joint) slip_grip(model, state, positions, events);
  emit_reached(model, state, turned, events);
  if (has_arrived(state, turned, model.tool_index()) && !turned.opened)
    warn_of_touch(model, state, positions, events);
  update_blocked(model, state, positions, events);
}

// Whether is_at_rest(). Inline, because every advance of time calls it.
inline bool rests(const Model& model, const State& state) {
  if (state.stall != Stall::kNo) return true;
  for (int i = 0; i < model.motor_count(); ++i) {
    if (will_run(state, i)) return false;
  }
  return true;
}

}  // namespace

bool is_at_rest(const Model& model, const State& state) { return rests(model, state); }

void step(const Model& model, State& state, Events& events) {
  tick(model, state, events);
  assert(broken_invariant(model, state) == nullptr);
}

namespace {

// Advances to `target` or until the machine is at rest, but makes at least the next step. Separate
// from its callers, so that at rest they cost little. Precondition: state.tick < target.
void run(const Model& model, State& state, Tick target, Events& events) {
  assert(state.tick < target);
  do {
    coast(model, state, quiet_ticks(model, state, target - state.tick));
    if (state.tick < target) step(model, state, events);
  } while (state.tick < target && !rests(model, state));
}

}  // namespace

bool run_to_rest(const Model& model, State& state, Tick target, Events& events) {
  if (state.tick >= target || rests(model, state)) return false;
  run(model, state, target, events);
  return true;
}

bool advance_to(const Model& model, State& state, Tick target, Events& events) {
  bool changed = run_to_rest(model, state, target, events);
  while (state.faults.now.next_stop <= target && state.tick < target) {
    state.tick = state.faults.now.next_stop - 1;
    run(model, state, target, events);
    changed = true;
  }
  state.tick = std::max(state.tick, target);
  return changed;
}

}  // namespace xr3
