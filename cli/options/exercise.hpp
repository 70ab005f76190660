// The command line of `xr3 exercise`.
#pragma once

#include <cstddef>
#include <string>

#include "cli/options/cli_fwd.hpp"

namespace xr3 {

struct ExerciseOptions {
  std::string action;     ///< `check`
  std::string exercise;   ///< a name, a folder or a zip archive
  std::size_t seeds = 5;  ///< seeds with which a solution must pass, if the exercise varies
  std::size_t jobs = 0;   ///< programs that run at a time; 0 for the default
};

void add_exercise(CLI::App& app, ExerciseOptions& options);

}  // namespace xr3
