// Finds the goals that a robot at rest meets without a program.
#pragma once

#include <optional>
#include <vector>

#include "core/faults/fault.hpp"
#include "core/model.hpp"
#include "core/units.hpp"
#include "protocol/goals/goal.hpp"

namespace xr3 {

/// Maximum simulated time in which a robot comes to rest before it is judged.
inline constexpr Tick kRestLimit = Tick{128} * kTickHz;

/// Judges a fresh robot to which no program is connected: one element for each goal, true if it is
/// met. Precondition: the model has the blocks and joints that the goals name, and the joints of
/// the faults.
std::vector<bool> passive_goals(const GoalList& goals, const ModelPtr& model,
                                const std::optional<FaultPlan>& faults);

}  // namespace xr3
