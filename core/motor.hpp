// A motor with an 8-bit error counter and an integer phase (paper, Section II-B; the wrapping is
// that of the hardware). Each tick a running motor adds its speed to its phase; 1000 make one
// count.
#pragma once

#include "core/coupling.hpp"
#include "core/event.hpp"
#include "core/grasp.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

inline constexpr int kPhasePerCount = 1000;

/// Adds counts (-128...127) to the error counter in 8-bit arithmetic. Returns whether it wrapped.
bool add_to_error(MotorState& motor, int counts);

/// Sets the error counter. Resets the phase if the counter is now 0 or has changed sign.
void set_error(MotorState& motor, std::int8_t error);

/// Ticks until a running motor makes its next count; at least 1.
inline Tick ticks_to_count(const MotorState& motor) {
  return (kPhasePerCount - motor.phase + motor.speed - 1) / motor.speed;
}

/// The obstacle to the next count of a motor with a nonzero error counter: the limit of a joint
/// that it moves, or the block in the jaws.
Blocked obstacle(const Model& model, const State& state, const Positions& positions, int index);

/// The result of one tick of all motors.
struct MotorTickResult {
  MotorBits counted = 0;  ///< the motors that made a count
  bool any = false;       ///< a count was made, or the jaws met a block; if not, nothing follows
  bool joint = false;     ///< a joint moved, not only tool or carousel
  bool table = false;     ///< the carousel turned
  bool opened = false;    ///< the tool's motor made an opening count
  JawContact jaws;        ///< the obstacle to the tool's closing count
};

/// One tick of every motor: joints from the base, the tool, then the carousel. The check of each
/// count sees the counts already made in this tick. Updates `positions`. The events are those of
/// faults.
MotorTickResult turn_motors(const Model& model, State& state, Positions& positions, Events& events);

/// Recomputes which motors are blocked and appends an event for each newly blocked one. Call after
/// counts were made or error counters changed.
void update_blocked(const Model& model, State& state, const Positions& positions, Events& events);

}  // namespace xr3
