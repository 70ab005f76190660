// `xr3 watch`: a terminal view of a monitor port, which comes back by itself when the server does.
#pragma once

#include "server/exit_code.hpp"
#include "server/watch_options.hpp"

namespace xr3 {

/// Until a key or a signal ends it. With --once, or where standard output is no terminal, one screen
/// as text: kNoServer, with a sentence on standard error, if nobody answers within a few seconds;
/// kBadInput if the server refuses what was asked for. Throws FileError or TokenError for --token-file.
ExitCode watch_cell(const WatchOptions& options);

}  // namespace xr3
