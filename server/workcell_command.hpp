// `xr3 workcell NEW.json`: the workcell editor in a terminal. The dialogue itself is protocol's; this
// connects it with standard input and output and writes the file.
#pragma once

#include "server/options.hpp"

namespace xr3 {

/// kBadInput if the input ends, or Ctrl-C or SIGTERM breaks it off, with something unsaved. Throws
/// FileError and DataError for files that cannot be opened or used.
ExitCode edit_workcell(const WorkcellOptions& options);

}  // namespace xr3
