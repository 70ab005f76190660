// `xr3 convert RUN.xr3rec RUN.mcap`.
#pragma once

#include "cli/options/options.hpp"
#include "server/base/exit_code.hpp"

namespace xr3 {

/// Repeats the recording, and writes the messages of the live Foxglove endpoint into an MCAP file.
/// kBadInput if OUT exists and `force` is not set; kDifferent, without a file, if the replay
/// differs from the recording. Throws FileError or DataError.
ExitCode convert_recording(const ConvertOptions& options);

}  // namespace xr3
