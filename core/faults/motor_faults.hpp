// The effects of faults on motors, encoders, microswitches and the grip of the jaws. Every function
// costs one comparison if there are no such faults.
#pragma once

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The number of the ticks (from, to] in which a motor of this speed runs: they are spread evenly
/// over all ticks.
constexpr Tick running_ticks(std::uint8_t percent, Tick from, Tick to) {
  return to * percent / kFullSpeed - from * percent / kFullSpeed;
}

/// The first tick after `from` by which a motor of this speed has run for `ticks` ticks, at least
/// 1. kNoTick if it does not run.
constexpr Tick tick_after_running(std::uint8_t percent, Tick from, Tick ticks) {
  if (percent == 0) return kNoTick;
  return ((from * percent / kFullSpeed + ticks) * kFullSpeed + percent - 1) / percent;
}

inline std::uint8_t speed_percent_of(const State& state, int motor) {
  return state.faults.now.speed_percent[static_cast<std::size_t>(motor)];
}

/// The motor will make counts without new input, unless the robot is stalled.
inline bool will_run(const State& state, int motor) {
  return is_running(state.motor(motor)) && !has_motor(state.faults.now.stuck_for_good, motor);
}

/// Whether loses_count() may return true.
inline bool may_lose_count(const State& state, int motor) {
  return has_motor(state.faults.now.slipping | state.faults.slipped, motor);
}

/// Whether a motor's encoder misses the count that the motor makes now: the motor turns, but its
/// error counter is not updated. At most every second count is missed, so that no motor runs for
/// ever. Counts the effect.
bool loses_count(const Model& model, State& state, int motor, Events& events);

/// The state of a microswitch whose contact is `is_closed`, or that of a fault that makes it stuck.
inline bool with_stuck_switch(const State& state, int motor, bool is_closed) {
  const FaultsInForce& now = state.faults.now;
  return (is_closed || has_motor(now.closed, motor)) && !has_motor(now.open, motor);
}

/// Makes a microswitch that has just changed begin to bounce, if a fault says so.
void begin_bounce(const Model& model, State& state, int motor, Events& events);

/// The controller's reading of a microswitch at this tick, including bounces.
bool reads_closed(const Model& model, const State& state, int motor);

/// Lets the held block, if any, slip out of the jaws if a fault says so. Call in each tick in which
/// a joint of the arm has moved.
void slip_grip(const Model& model, State& state, const Positions& positions, Events& events);

}  // namespace xr3
