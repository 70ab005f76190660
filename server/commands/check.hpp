// `xr3 check FILE...`: reports the errors in each file, or a summary of it.
#pragma once

#include "server/options/options.hpp"

namespace xr3 {

/// Findings go to standard error, summaries to standard output. kBadInput if a file has an error.
ExitCode check_files(const CheckOptions& options);

}  // namespace xr3
