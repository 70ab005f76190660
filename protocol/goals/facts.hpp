// Facts about a run that its end does not show: collected by cell/judge while the run continues.
// Values only.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/event.hpp"
#include "core/units.hpp"

namespace xr3 {

/// The reason why a run ended.
enum class RunOutcome : std::uint8_t {
  kFinished,  ///< the program ended with exit code 0
  kFailed,    ///< the program could not be started, or ended with another code or by a signal
  kTimeUp,    ///< a limit was reached
  kNotRun,    ///< the run was not made, or not to its end
};

/// A problem that was reported, with the number of times.
struct RunProblem {
  Tick tick = 0;  ///< tick of the first time
  std::string code;
  std::string message;  ///< message of the first time
  std::uint64_t count = 0;
};

/// The place where a goal for the whole run was first missed.
struct Breach {
  Tick tick = 0;
  std::string block;  ///< empty if it was the tool tip
  PointUm at;
};

struct RunFacts {
  /// Maximum number of each; further ones are only counted.
  static constexpr std::size_t kMaxHappenings = 10'000;
  static constexpr std::size_t kMaxProblems = 100;

  std::vector<std::string> happenings;  ///< "grasped NAME" and "released NAME", in order
  std::optional<Stall> stall;           ///< the first one
  Tick stall_tick = 0;
  std::optional<Tick> soft_home_tick;  ///< tick at which the controller's soft home was first used
  std::vector<RunProblem> problems;
  std::uint64_t problem_count = 0;
  Tick last_count_tick = 0;  ///< 0 if no motor made a count
  std::uint64_t bytes = 0;   ///< number received on all lines
  Micrometres tip_path_um = 0;
  std::vector<std::optional<Breach>> breaches;  ///< one for each goal
};

}  // namespace xr3
