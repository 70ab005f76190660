// The run of one program against one fresh robot, from its start to its judgement.
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
  ServeOptions server;  ///< for the robot; its `record` is the file of this run
  CellSeed seed;
  ExecOptions exec;                 ///< for the program; its `command` is that of this run
  std::optional<ProgramUser> user;  ///< of the program; nullopt: that of this process
  std::string output_file;          ///< keeps what the program prints; empty: it is only passed on
  std::string refused;              ///< why the program is not run; empty: it is
};

struct RunResult {
  RunReport report;        ///< without the name of the program and the seed
  std::string transcript;  ///< as TranscriptText shows it
  ModelPtr model;
  State end;
};

/// Runs the program and judges the run. SIGINT is passed on to it, and SIGTERM, which ends the run
/// after a grace period. Throws FileError, and std::system_error if this process lacks something.
RunResult run_program(const RunSettings& settings, const GoalList& goals);

}  // namespace xr3
