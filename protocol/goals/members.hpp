// The tables of members of each kind of goal in a goals file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/goals/goal.hpp"
#include "protocol/json/codec.hpp"

namespace xr3::data {

/// Reads one goal of the kind that its member `kind` says. Reports what is wrong.
bool read_goal(const Place& place, Goal& goal);

/// The names of the kinds, in the order of goal::Body.
const std::vector<std::string>& goal_kinds();
/// The name of a goal's kind.
const std::string& kind_of(const Goal& goal);

}  // namespace xr3::data
