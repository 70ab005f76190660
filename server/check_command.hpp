// `xr3 check FILE...`: all that is wrong in the files, or a summary of each.
#pragma once

#include "server/options.hpp"

namespace xr3 {

/// Findings go to standard error, summaries to standard output. kBadInput if a file has an error.
ExitCode check_files(const CheckOptions& options);

}  // namespace xr3
