// Inter-axis coupling (paper, Sections II-B and III-A): a joint's position is the count of its own
// motor plus or minus the counts of the motors coupled to it. Coupling is not transitive.
#pragma once

#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Position of a joint or the tool in counts.
Counts position(const Model& model, const Motors& motors, int index);

/// The positions of all joints and the tool, in counts.
Positions positions(const Model& model, const Motors& motors);

/// Updates `positions` for `counts` counts of motor `motor`, coupled joints included.
void turn(const Model& model, Positions& positions, int motor, Counts counts);

/// The motor counts that bring the joints to the given positions; the inverse of positions().
Positions motor_counts(const Model& model, const Positions& wanted);

}  // namespace xr3
