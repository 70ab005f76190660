// The report of `xr3 check` about a data file: its kind, all findings, and a summary. The caller
// reads the file, prints the report and chooses the exit code.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/faults/fault.hpp"
#include "core/model.hpp"
#include "core/robot.hpp"
#include "core/workcell.hpp"
#include "protocol/files/exercise.hpp"
#include "protocol/files/kind.hpp"
#include "protocol/goals/goal.hpp"
#include "protocol/json/finding.hpp"

namespace xr3 {

/// The findings, and if none of them is an error, the value and its summary.
struct CheckResult {
  DataKind kind = DataKind::kUnknown;
  Findings findings;    ///< sorted by line; print each with to_text
  std::string summary;  ///< lines, each with a line feed; empty if there are errors
  std::optional<Robot> robot;
  std::optional<Workcell> workcell;
  std::optional<FaultPlan> faults;
  std::optional<GoalList> goals;
  std::optional<ExerciseFile> exercise;

  bool is_good() const { return !has_errors(findings); }
};

/// The result of a file that has been read. The profile determines the range of switches without a
/// width.
CheckResult robot_result(FileReading<Robot> reading, Profile profile);
CheckResult workcell_result(FileReading<Workcell> reading);

/// Checks the text of any data file, see kind_of(): a workcell against the robot's tool, faults
/// against its joints.
CheckResult check_text(std::string_view text, const std::string& file, Profile profile,
                       const Robot* robot = nullptr);

}  // namespace xr3
