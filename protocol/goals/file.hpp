// Converts goals files (docs/exec.md) from text to values. The text comes from the caller; no file
// is read here.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/model.hpp"
#include "protocol/goals/goal.hpp"
#include "protocol/json/finding.hpp"

namespace xr3 {

/// The result of reading a goals file. `list` is set unless a finding is an error; the findings are
/// sorted by line.
struct GoalsReading {
  std::optional<GoalList> list;
  Findings findings;
};

/// Reads and checks a goals file. `model`: the robot and workcell whose joints and blocks the goals
/// may name; null: any. Syntax errors are findings, too. Never throws.
GoalsReading read_goals(std::string_view text, const std::string& file,
                        const Model* model = nullptr);

/// Reads and checks a goals file. Throws DataError with all findings if one of them is an error.
GoalList load_goals(std::string_view text, const std::string& file, const Model& model);

/// The text that `xr3 check` prints of a good file.
std::string goals_summary(const GoalList& list);

}  // namespace xr3
