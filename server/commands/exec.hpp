// `xr3 exec`: runs a program against fresh robots, judges the runs, and reports.
#pragma once

#include "server/exit_code.hpp"
#include "server/options/options.hpp"

namespace xr3 {

/// Returns kTimeUp before kProgramFailed before kDifferent before kGoalsMissed. Throws FileError,
/// DataError and std::system_error.
ExitCode exec_program(const ExecCommand& command);

}  // namespace xr3
