// An exercise as a folder: exercise.json with the files that it names, the sheet, and programs that
// solve it or fail (docs/exercises.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/exec/run_folder.hpp"
#include "cli/options/options.hpp"
#include "protocol/files/exercise.hpp"

namespace xr3 {

class ExerciseFolder {
 public:
  /// Finds an exercise. `what` is a path of a folder or a zip archive if it contains a slash or
  /// ends in .zip; else the name of an exercise that comes with xr3, else a folder here. Throws
  /// FileError and DataError.
  explicit ExerciseFolder(const std::string& what);

  const std::filesystem::path& path() const { return path_; }
  const ExerciseFile& file() const { return file_; }

  /// Sets the options that the exercise states: goals, and the variation unless there is one.
  /// Throws FileError if the variation is invalid.
  void set(ExecOptions& options) const;
  /// Sets robot, workcell, faults and clock. Throws FileError if the clock is invalid.
  void set(ServeOptions& options) const;
  /// Sets robot, workcell and faults, and the goals with their title: for programs that are watched
  /// while they are written, on any clock.
  void set_for_lesson(ServeOptions& options) const;

 private:
  void set_machine(ServeOptions& options) const;
  std::string place_of(const std::string& name) const;
  [[noreturn]] void refuse(const char* member, const std::string& why) const;

  std::optional<RunFolder> unpacked_;  ///< the unpacked archive, if it is one
  std::filesystem::path path_;
  ExerciseFile file_;
};

}  // namespace xr3
