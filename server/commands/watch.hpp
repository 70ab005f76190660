// `xr3 watch`: shows a robot in the terminal, through the monitor port. Reconnects automatically.
#pragma once

#include "server/exit_code.hpp"
#include "server/options/watch.hpp"

namespace xr3 {

/// Runs until a key or a signal ends it. With --once, or if standard output is not a terminal,
/// prints one screen as text: returns kNoServer, with a sentence on standard error, if no server
/// answers within a few seconds; kBadInput if the server refuses the request. Throws FileError or
/// TokenError for --token-file.
ExitCode watch_cell(const WatchOptions& options);

}  // namespace xr3
