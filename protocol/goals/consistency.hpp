// The rules for goals that concern several members, or the robot and its workcell.
#pragma once

#include "core/model.hpp"
#include "protocol/goals/goal.hpp"
#include "protocol/json/codec.hpp"

namespace xr3 {

/// Reports what does not fit. `model` may be null: then names of blocks and joints are not checked.
void check_goals(const GoalList& list, const Model* model, data::Reading& reading);

}  // namespace xr3
