// A motor with an 8-bit error counter and an integer phase (paper, Section II-B; hardware for the
// wrapping): each tick a running motor adds its speed to the phase, and 1000 of it make one count.
#pragma once

#include "core/coupling.hpp"
#include "core/event.hpp"
#include "core/grasp.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

inline constexpr int kPhasePerCount = 1000;

/// It has counts to go and nothing in its way.
inline bool is_running(const MotorState& motor) {
  return motor.error != 0 && motor.blocked == Blocked::kNo;
}

/// Adds counts to the error counter as 8 bits do. Returns whether that wrapped. counts: -128...127.
bool add_to_error(MotorState& motor, int counts);

/// Sets the error counter, and the phase to 0 where the counter is 0 or has changed sign.
void set_error(MotorState& motor, std::int8_t error);

/// Ticks from now to the one in which a running motor makes its next count: 1 and up.
inline Tick ticks_to_count(const MotorState& motor) {
  return (kPhasePerCount - motor.phase + motor.speed - 1) / motor.speed;
}

/// What stands in the way of the next count of a motor that has one to make: the limit of a joint that
/// it moves, or the block that the jaws hold.
Blocked obstacle(const Model& model, const State& state, const Positions& positions, int index);

/// What the motors did in a tick.
struct Turned {
  bool any = false;     ///< a count was made, or the jaws met a block
  bool joint = false;   ///< the arm moved, not the tool alone
  bool opened = false;  ///< the tool's motor made an opening count
  JawContact jaws;      ///< what its closing count met
};

/// One tick of every motor, joints from the base and then the tool; each count is checked against
/// those already made. Keeps `positions` up to date.
Turned turn_motors(const Model& model, State& state, Positions& positions);

/// Marks the motors that cannot make their next count, frees those that can again, and tells of each
/// that came to stand. Call it after counts were made or error counters changed.
void update_blocked(const Model& model, State& state, const Positions& positions, Events& events);

}  // namespace xr3
