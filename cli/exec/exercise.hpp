// A task for robot programs: the robot, the goals and the limits, loaded once, and runs of programs
// with their files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/exec/exercise_folder.hpp"
#include "cli/exec/kept_transcripts.hpp"
#include "cli/exec/run.hpp"
#include "cli/options/options.hpp"
#include "server/net/wall_clock.hpp"
#include "tools/report/run_report.hpp"

namespace xr3 {

/// The last file of a run's folder: with it the folder is complete.
inline constexpr const char* kResultFile = "result.json";

/// The program, the files and the number of one run.
struct RunPlace {
  std::string title;  ///< title of the report
  std::vector<std::string> command;
  std::string readable;  ///< a path readable in a sandbox beside those that the command names
  std::string folder;    ///< new, for output, recording, picture and result; empty if there is none
  std::string record;    ///< file of the recording without a folder; empty if there is none
  /// Number from 1 of several runs, each with the next seed; 0 for the only one.
  std::size_t run = 0;
  std::string refused = {};  ///< reason to judge it without a run; empty to run it
  std::size_t job = 0;       ///< index; selects the user of the run if the judge is root
  const KeptTranscripts* transcripts =
      nullptr;  ///< transcripts of several runs; nullptr if there is one
};

class Exercise {
 public:
  /// Loads the robot, the workcell, the faults and the goals, those of an exercise if `options`
  /// names one. Throws FileError and DataError.
  Exercise(const ExecOptions& options, const ServeOptions& server)
      : Exercise(Sources(options, server)) {}

  /// Runs a program. Throws FileError if a file cannot be written, or no place was found for a
  /// block.
  RunReport run(const RunPlace& place) const;

  /// The title of the exercise that the options name; empty if they name none.
  const std::string& title() const { return title_; }
  Profile profile() const { return seed_.model->profile(); }

  /// Whether each run has its own places of the blocks.
  bool is_varied() const { return options_.vary.has_value(); }

  /// Time after which a process that makes a run has failed; 0 if unlimited.
  WallNs run_limit() const;

 private:
  /// The options, completed by those of an exercise, whose files exist for the lifetime of this.
  struct Sources {
    Sources(ExecOptions exec_options, ServeOptions server_options);
    ExecOptions exec;
    ServeOptions server;
    std::optional<ExerciseFolder> folder;
  };

  explicit Exercise(const Sources& sources);
  std::optional<Variation> variation_of(std::size_t run) const;
  CellSeed seed_of(std::size_t run) const;

  std::string title_;
  ExecOptions options_;
  ServeOptions server_;
  CellSeed seed_;
  GoalList goals_;
};

/// The report that the process of a run has returned; if it returned none, or no report, one that
/// says that the run could not be made. `run`: as in RunPlace.
RunReport report_of(const std::optional<std::string>& text, const std::string& title,
                    std::size_t run = 0);

/// The number of programs that run at a time by default.
std::size_t usual_jobs();

}  // namespace xr3
