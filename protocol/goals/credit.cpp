#include "protocol/goals/credit.hpp"

#include <algorithm>
#include <cassert>

namespace xr3 {
namespace {

bool has_met_an_active(const std::vector<GoalResult>& results, const std::vector<bool>& passive) {
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].is_met && !passive[i]) return true;
  return false;
}

/// The reason why the run gets no points; empty if it gets some.
std::string refusal(const std::vector<GoalResult>& results, const GoalList& list,
                    const std::vector<bool>& passive, RunOutcome outcome, const RunFacts& facts) {
  if (outcome == RunOutcome::kFailed && !list.failed_program_counts) return "the program failed";
  if (has_met_an_active(results, passive)) return "";
  if (std::find(passive.begin(), passive.end(), false) != passive.end())
    return "a robot without a program meets them, too, and no other goal is met";
  const bool is_run = outcome == RunOutcome::kFinished && facts.last_count_tick > 0;
  return is_run ? ""
                : "a robot without a program meets all goals; they count if the program moves the "
                  "robot and ends with exit code 0";
}

}  // namespace

std::string withhold(std::vector<GoalResult>& results, const GoalList& list,
                     const std::vector<bool>& passive, RunOutcome outcome, const RunFacts& facts) {
  assert(passive.size() == results.size());
  if (std::none_of(results.begin(), results.end(),
                   [](const GoalResult& each) { return each.is_met; }))
    return "";
  std::string why = refusal(results, list, passive, outcome, facts);
  for (GoalResult& each : results) each.is_counted = why.empty() || !each.is_met;
  return why;
}

}  // namespace xr3
