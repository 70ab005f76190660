#include "cli/exec/exercise_folder.hpp"

#include <algorithm>
#include <stdexcept>

#include "cli/exec/unzip.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

bool is_exercise(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / kExerciseFile, error);
}

std::string list_of_names() {
  std::string list;
  for (const std::string& each : names_of_exercises()) list += (list.empty() ? "" : ", ") + each;
  return list;
}

fs::path find(const std::string& what) {
  const bool is_path = what.find('/') != std::string::npos || what.ends_with(".zip");
  if (!is_path && is_exercise(exercises_folder() / what)) return exercises_folder() / what;
  std::error_code error;
  if (fs::exists(what, error)) return what;
  if (is_path) throw FileError(what + ": there is no such folder or archive");
  throw FileError("there is no exercise named " + what + "; use one of: " + list_of_names() +
                  "; or the path of a folder or a zip archive");
}

/// The folder with the files: an archive may contain them directly, or in one folder.
fs::path top_of(const fs::path& folder) {
  const fs::directory_iterator entries(folder);
  const auto inner = std::ranges::find_if(entries, is_exercise, &fs::directory_entry::path);
  return is_exercise(folder) || inner == fs::end(entries) ? folder : inner->path();
}

}  // namespace

ExerciseFolder::ExerciseFolder(const std::string& what) : path_(find(what)) {
  if (!fs::is_directory(path_)) {
    const fs::path folder = unpacked_.emplace(std::nullopt).file("exercise");
    unzip(path_, folder);
    path_ = top_of(folder);
  }
  if (!is_exercise(path_)) throw FileError(what + ": there is no " + kExerciseFile + " in it");
  const DataFile data = read_file(path_ / kExerciseFile);
  file_ = load_exercise(data.text, data.path);
}

void ExerciseFolder::set(ExecOptions& options) const {
  options.goals = place_of(file_.goals);
  if (options.vary || file_.vary.empty()) return;
  try {
    options.vary = parse_variation(file_.vary);
  } catch (const std::invalid_argument& error) {
    refuse("vary", error.what());
  }
}

void ExerciseFolder::set_for_lesson(ServeOptions& options) const {
  set_machine(options);
  options.goals = place_of(file_.goals);
  options.exercise_title = file_.title;
}

void ExerciseFolder::set_machine(ServeOptions& options) const {
  if (!file_.robot.empty()) options.robot = place_of(file_.robot);
  if (!file_.workcell.empty()) options.workcell = place_of(file_.workcell);
  if (!file_.faults.empty()) options.fault_file = place_of(file_.faults);
}

void ExerciseFolder::set(ServeOptions& options) const {
  set_machine(options);
  if (!file_.clock.empty()) try {
      options.clock = parse_clock(file_.clock);
    } catch (const std::invalid_argument& error) {
      refuse("clock", error.what());
    }
}

/// The path of a file that is given as a name in the folder.
std::string ExerciseFolder::place_of(const std::string& name) const {
  return is_data_path(name) ? (path_ / name).lexically_normal().string() : name;
}

void ExerciseFolder::refuse(const char* member, const std::string& why) const {
  throw FileError((path_ / kExerciseFile).string() + ": /" + member + ": " + why);
}

}  // namespace xr3
