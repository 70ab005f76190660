// Reads exercise files (docs/exercises.md): the robot, the time and the goals of a task for robot
// programs. The text comes from the caller; no file is read here.
#pragma once

#include <string>
#include <string_view>

#include "protocol/json/codec.hpp"

namespace xr3 {

/// The contents of an `exercise.json`. Robot, workcell, faults and goals are names, or files of its
/// folder; clock and variation are written as the options of `xr3 exec`. An empty member means the
/// default of the option.
struct ExerciseFile {
  std::string title;
  std::string notes;
  std::string robot;
  std::string workcell;
  std::string faults;
  std::string clock;
  std::string vary;
  std::string goals;
};

/// Reads and checks an exercise file. Syntax errors are findings, too. Never throws.
FileReading<ExerciseFile> read_exercise(std::string_view text, const std::string& file);

/// Reads and checks an exercise file. Throws DataError with all findings if one of them is an
/// error.
ExerciseFile load_exercise(std::string_view text, const std::string& file);

/// The summary that `xr3 check` prints of a good file.
std::string exercise_summary(const ExerciseFile& exercise);

}  // namespace xr3
