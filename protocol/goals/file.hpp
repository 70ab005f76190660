// Converts goals files (docs/exec.md) from text to values. The text comes from the caller; no file
// is read here.
#pragma once

#include <string>
#include <string_view>

#include "core/model.hpp"
#include "protocol/goals/goal.hpp"
#include "protocol/json/codec.hpp"

namespace xr3 {

/// Reads and checks a goals file. `model`: the robot and workcell whose joints and blocks the goals
/// may name; nullptr if any names are allowed. Syntax errors are findings, too. Never throws.
FileReading<GoalList> read_goals(std::string_view text, const std::string& file,
                                 const Model* model = nullptr);

/// Reads and checks a goals file. Throws DataError with all findings if one of them is an error.
GoalList load_goals(std::string_view text, const std::string& file, const Model& model);

/// The name of a goal's kind.
const std::string& kind_of(const Goal& goal);

/// The rules that concern several members, or the robot and its workcell. If `model` is nullptr,
/// names of blocks and joints are not checked.
void check_goals(const GoalList& list, const Model* model, data::Reading& reading);

/// The summary that `xr3 check` prints of a good file.
std::string goals_summary(const GoalList& list);

}  // namespace xr3
