// The run of one program against one fresh robot, from its start to its judgement.
//
// The flow through the folder: an Exercise (exercise.hpp) loads robot, workcell, faults and goals,
// perhaps from an exercise folder (exercise_folder.hpp, unzip.hpp), and makes runs; pool.hpp runs
// several in processes of their own. run_program() opens a fresh cell with ports and a
// pseudo-terminal (robot_host.hpp) in a folder of the run (run_folder.hpp), and starts the program
// (program.hpp, launch.hpp) as the chosen user. A sandbox adds bubblewrap (sandbox.hpp), a network
// with only the robot (private_network.hpp) and a filter of system calls (system_calls.hpp). One
// event loop serves robot and program, keeps the output (kept_output.hpp) and checks the limits:
// wall time, simulated time (cell/judge/sim_limit.hpp), bytes, memory and processes (usage.hpp). At
// the end or at a limit all descendants are ended (descendants.hpp), arrived bytes are executed,
// the robot moves to rest, and the goals are judged. The result is a RunReport for tools/report,
// and the transcript (transcript_text.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/exec/program.hpp"
#include "cli/exec/robot_host.hpp"
#include "cli/options/options.hpp"
#include "core/model.hpp"
#include "core/state.hpp"
#include "protocol/goals/goal.hpp"
#include "server/cells/seed.hpp"
#include "tools/report/run_report.hpp"

namespace xr3 {

struct RunSettings {
  ServeOptions server;  ///< options for the robot; `record` is the file of this run
  CellSeed seed;
  ExecOptions exec;                 ///< options for the program; `command` is that of this run
  std::optional<ProgramUser> user;  ///< user of the program; nullopt for that of this process
  std::string output_file;          ///< file for the program's output; empty to only show it
  std::string refused;              ///< reason why the program is not run; empty to run it
};

struct RunResult {
  RunReport report;        ///< without the name of the program and the seed
  std::string transcript;  ///< transcript in the form of TranscriptText
  ModelPtr model;
  State end;
};

/// Runs the program and judges the run. Passes SIGINT on to the program, and SIGTERM, which ends
/// the run after a grace period. Throws FileError, and std::system_error if the system refuses a
/// resource.
RunResult run_program(const RunSettings& settings, const GoalList& goals);

}  // namespace xr3
