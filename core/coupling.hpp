// Inter-axis coupling (paper, Sections II-B and III-A): a joint's position is its own motor's counts
// plus what the motors coupled to it add. It acts on motor counts, once, and is not passed on.
#pragma once

#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Position of one joint (or the tool) in counts.
Counts position(const Model& model, const Motors& motors, int index);

Positions positions(const Model& model, const Motors& motors);

/// Moves every joint that motor `motor` drives by so many of its counts.
void turn(const Model& model, Positions& positions, int motor, Counts counts);

/// The motor counts that bring the joints to the given positions: coupling taken out again.
Positions motor_counts(const Model& model, const Positions& wanted);

}  // namespace xr3
