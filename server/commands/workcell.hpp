// `xr3 workcell NEW.json`: the workcell editor in a terminal. Connects the dialogue of
// tools/workcell_editor with standard input and output and writes the file.
#pragma once

#include "server/options/options.hpp"

namespace xr3 {

/// Returns kBadInput if the input ends, or a signal (such as Ctrl-C) interrupts it, with unsaved
/// changes. Throws FileError or DataError if a file cannot be opened or used.
ExitCode edit_workcell(const WorkcellOptions& options);

}  // namespace xr3
