// `xr3 replay`: repeats a recording, compares, and shows the end or goes on from it.
#pragma once

#include "server/options/options.hpp"

namespace xr3 {

/// Repeats the recording and writes what the options ask for. kDifferent if something differs.
/// Throws FileError and DataError.
ExitCode replay_file(const ReplayOptions& options);

/// The same, and then serves until it is stopped. Nothing is served after a difference.
ExitCode replay_and_serve(const ReplayCommand& command);

}  // namespace xr3
