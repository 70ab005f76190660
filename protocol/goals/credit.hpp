// Decides whether the goals that a run has met count. A goal is passive if a robot at rest meets it
// without a program: alone it shows nothing about a program. docs/exec.md, section "Points", has
// the rules.
#pragma once

#include <string>
#include <vector>

#include "protocol/goals/facts.hpp"
#include "protocol/goals/goal.hpp"
#include "protocol/goals/judge.hpp"

namespace xr3 {

/// Withholds the points of met goals that do not count. Returns the reason, as a part of a sentence
/// for a student; empty if all count. `passive` has one element for each goal.
std::string withhold(std::vector<GoalResult>& results, const GoalList& list,
                     const std::vector<bool>& passive, RunOutcome outcome, const RunFacts& facts);

}  // namespace xr3
