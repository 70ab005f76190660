#include "core/motor.hpp"

#include <cassert>

#include "core/faults/motor_faults.hpp"

namespace xr3 {
namespace {

int sign(int value) { return (value > 0) - (value < 0); }

// The first joint moved by motor `index` that its next count would take past a limit, or -1.
int limited_joint(const Model& model, const Positions& positions, int index, int direction) {
  for (const CoupledJoint& driven : model.driven_by(index)) {
    const int change = driven.gain * direction;
    const Counts next = positions[driven.joint] + change;
    const MotorModel& joint = model.motor(driven.joint);
    // Only the limit in the direction of motion counts: a joint past a limit may always move back.
    if (change > 0 ? next > joint.high : next < joint.low) return driven.joint;
  }
  return -1;
}

MotorBlocked blocked_event(const Model& model, const State& state, const Positions& positions,
                           int index) {
  const MotorState& motor = state.motor(index);
  MotorBlocked event{
      model.motor(index).drive.label, motor.blocked, 0, false, 0.0, motor.count, motor.error};
  if (motor.blocked != Blocked::kLimit) return event;
  const int direction = sign(motor.error);
  const int joint = limited_joint(model, positions, index, direction);
  const Drive& limited = model.motor(joint).drive;
  event.by = limited.label;
  event.upper = (model.gain(joint, index) * direction > 0) == (limited.direction > 0);
  event.limit = event.upper ? limited.max : limited.min;
  return event;
}

// Inline: g++ would call it, at every count.
inline void make_count(const Model& model, State& state, Positions& positions, int index,
                       MotorTickResult& turned, Events& events) {
  MotorState& motor = state.motor(index);
  const int direction = sign(motor.error);
  const bool is_lost = may_lose_count(state, index) && loses_count(model, state, index, events);
  turned.counted |= bit_of(index);
  motor.count += direction;
  turn(model, positions, index, direction);
  if (!is_lost) set_error(motor, static_cast<std::int8_t>(motor.error - direction));
}

// Adds one tick of phase. Returns true if a count is due.
bool gathers_a_count(State& state, int index) {
  MotorState& motor = state.motor(index);
  if (!is_running(motor)) return false;
  const std::uint8_t percent = speed_percent_of(state, index);
  if (percent != kFullSpeed && running_ticks(percent, state.tick - 1, state.tick) == 0)
    return false;
  motor.phase = static_cast<std::int16_t>(motor.phase + motor.speed);
  if (motor.phase < kPhasePerCount) return false;
  motor.phase = static_cast<std::int16_t>(motor.phase - kPhasePerCount);
  return true;
}

// Makes the tool's count unless it would squeeze a block.
void turn_tool(const Model& model, State& state, Positions& positions, MotorTickResult& turned,
               Events& events) {
  const int tool = model.tool_index();
  turned.opened = opens_jaws(model, sign(state.motor(tool).error));
  if (!turned.opened) turned.jaws = next_closing(model, state, positions);
  if (turned.jaws.kind != JawContact::Kind::kHolds)
    make_count(model, state, positions, tool, turned, events);
}

}  // namespace

void set_error(MotorState& motor, std::int8_t error) {
  if (error == 0 || sign(error) != sign(motor.error)) motor.phase = 0;
  motor.error = error;
}

bool add_to_error(MotorState& motor, int counts) {
  assert(counts >= -128 && counts <= 127);
  const int sum = motor.error + counts;
  set_error(motor, static_cast<std::int8_t>(sum));
  return sum != motor.error;
}

Blocked obstacle(const Model& model, const State& state, const Positions& positions, int index) {
  const int direction = sign(state.motor(index).error);
  const bool squeezes = state.held && index == model.tool_index() && !opens_jaws(model, direction);
  if (squeezes) return Blocked::kBlock;
  const bool limited = limited_joint(model, positions, index, direction) >= 0;
  return limited ? Blocked::kLimit : Blocked::kNo;
}

MotorTickResult turn_motors(const Model& model, State& state, Positions& positions,
                            Events& events) {
  MotorTickResult turned;
  for (int i = 0; i < model.motor_count(); ++i) {
    if (!gathers_a_count(state, i)) continue;
    if (obstacle(model, state, positions, i) != Blocked::kNo) continue;  // see update_blocked()
    turned.any = true;
    if (i == model.tool_index()) {
      turn_tool(model, state, positions, turned, events);
      continue;
    }
    make_count(model, state, positions, i, turned, events);
    (i == model.carousel_index() ? turned.table : turned.joint) = true;
  }
  return turned;
}

void update_blocked(const Model& model, State& state, const Positions& positions, Events& events) {
  for (int i = 0; i < model.motor_count(); ++i) {
    MotorState& motor = state.motor(i);
    const Blocked before = motor.blocked;
    if (motor.error == 0) {
      motor.blocked = Blocked::kNo;
      continue;
    }
    motor.blocked = obstacle(model, state, positions, i);
    if (motor.blocked == Blocked::kNo) continue;
    motor.phase = 0;
    if (before == Blocked::kNo)
      events.push_back({state.tick, blocked_event(model, state, positions, i)});
  }
}

}  // namespace xr3
