// `xr3 term`: a terminal for a robot's serial line.
#pragma once

#include "server/exit_code.hpp"
#include "server/options/term.hpp"

namespace xr3 {

/// Runs until the user quits, or, if standard input or output is no terminal, until standard input
/// has ended and is answered. Returns kNoServer if the peer cannot be reached, is lost, or leaves
/// an inquiry of a script unanswered; kBadInput or kPortInUse if a device cannot be used; each with
/// a sentence on standard error. Throws FileError and DataError for --robot and --workcell.
ExitCode run_term(const TermOptions& options);

}  // namespace xr3
