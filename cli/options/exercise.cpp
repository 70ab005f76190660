#include "cli/options/exercise.hpp"

#include <CLI/CLI.hpp>

#include "cli/options/exec.hpp"
#include "cli/options/shared_options.hpp"

namespace xr3 {

void add_exercise(CLI::App& app, ExerciseOptions& options) {
  constexpr int kMaxSeeds = 1000;
  CLI::App& exercise = *app.add_subcommand(
      "exercise", "prove an exercise: its solutions pass, and its wrong programs fail");
  add_value(
      exercise, "action", options.action, "check",
      "check: runs the solutions, the starter, a program that does nothing, and the wrong ones")
      ->required()
      ->check(CLI::IsMember({"check"}).description(""));
  add_value(exercise, "exercise", options.exercise, "NAME|FOLDER|ZIP",
            "the exercise: a name, or its files")
      ->required();
  add_value(exercise, "--seeds", options.seeds, "N",
            "number of seeds with which a solution must pass, if the exercise varies")
      ->check(whole_number_between(1, kMaxSeeds))
      ->capture_default_str();
  add_value(exercise, "--jobs", options.jobs, "N", "number of programs that run at a time")
      ->check(whole_number_between(1, kMaxJobs));
}

}  // namespace xr3
