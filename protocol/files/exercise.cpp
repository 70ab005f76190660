#include "protocol/files/exercise.hpp"

#include <utility>

#include "protocol/files/kind.hpp"

namespace xr3 {
namespace {

using namespace data;  // NOLINT: keeps the table below readable

const Members<ExerciseFile>& exercise_members() {
  constexpr std::size_t kMaxTitle = 100;
  constexpr std::size_t kMaxNotes = 4000;
  const Codec<std::string> word = text(1, 200);
  static const Members<ExerciseFile> members = {
      required("title", &ExerciseFile::title, text(1, kMaxTitle)),
      optional("notes", &ExerciseFile::notes, text(0, kMaxNotes)),
      optional("robot", &ExerciseFile::robot, word),
      optional("workcell", &ExerciseFile::workcell, word),
      optional("faults", &ExerciseFile::faults, word),
      optional("clock", &ExerciseFile::clock, word),
      optional("vary", &ExerciseFile::vary, word),
      required("goals", &ExerciseFile::goals, word)};
  return members;
}

}  // namespace

FileReading<ExerciseFile> read_exercise(std::string_view text, const std::string& file) {
  return read_file(text, file, DataKind::kExercise, Unit::kMm, [](Reading& reading) {
    return read_root(reading, exercise_members(), [](const ExerciseFile&, Reading&) {});
  });
}

ExerciseFile load_exercise(std::string_view text, const std::string& file) {
  return value_of(read_exercise(text, file));
}

std::string exercise_summary(const ExerciseFile& exercise) {
  std::string text = exercise.title + "\n";
  if (!exercise.notes.empty()) text += exercise.notes + "\n";
  const auto add = [&text](const char* name, const std::string& value) {
    if (!value.empty()) text += std::string("  ") + name + " " + value + "\n";
  };
  add("robot", exercise.robot);
  add("workcell", exercise.workcell);
  add("faults", exercise.faults);
  add("clock", exercise.clock);
  add("vary", exercise.vary);
  add("goals", exercise.goals);
  return text;
}

}  // namespace xr3
