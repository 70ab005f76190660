// `xr3 healthcheck`: whether a server answers on this machine, for containers and scripts.
#pragma once

#include "server/exit_code.hpp"
#include "server/health_options.hpp"

namespace xr3 {

/// Asks, as long as it is told to. kNoServer: nobody answers as xr3 does; standard error says what came
/// instead.
ExitCode check_health(const HealthOptions& options);

}  // namespace xr3
