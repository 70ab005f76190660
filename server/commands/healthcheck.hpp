// `xr3 healthcheck`: checks whether a server answers on this machine, for containers and scripts.
#pragma once

#include "server/exit_code.hpp"
#include "server/options/healthcheck.hpp"

namespace xr3 {

/// Repeats the check for up to `wait_s`. Returns kNoServer if no healthy xr3 server answers,
/// kBadInput if the port file is invalid, with a sentence on standard error.
ExitCode check_health(const HealthOptions& options);

}  // namespace xr3
