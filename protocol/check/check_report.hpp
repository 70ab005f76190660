// The report of `xr3 check` about a data file: its kind, all findings, and a summary. The caller
// reads the file, prints the report and chooses the exit code.
//
// The flow through the folder: a caller passes the text of a file; no file is opened here. kind.hpp
// recognises robot, workcell, fault, goals and exercise files by their members. Each kind has a
// header: robot.hpp, workcell.hpp, faults.hpp, exercise.hpp, and protocol/goals/file.hpp. Its read
// function parses the JSON (protocol/json) with codecs and member tables, which also write the
// file; robot_parts.hpp and block.hpp are parts that several files share. Rules that concern
// several members follow: consistency.hpp, with one source for each kind. All errors and warnings
// become findings with file, line and JSON pointer, so that a user gets all of them at once; the
// load functions throw DataError instead. summary.hpp describes a good robot or workcell.
// paper_form/ converts the paper's plain form to the JSON of the same file first.
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
  std::string summary;  ///< lines, each with a line feed; empty after errors
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
