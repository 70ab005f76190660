// The command line of `xr3 healthcheck`.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>

namespace xr3 {

struct HealthOptions {
  std::string listen = "localhost";   ///< where serve listens, as it was told
  std::uint16_t monitor_port = 9601;  ///< counts where there is no port file
  std::string port_file;              ///< that serve writes; empty: none
  double wait_s = 0;                  ///< for so long it may be unhealthy; 0: one try
  std::string config;                 ///< a file that serve takes options from; empty: none
};

/// The subcommand `healthcheck` with its options.
void add_health(CLI::App& app, HealthOptions& options);

/// The address to ask where serve listens there: what listens everywhere is asked on this machine.
/// Takes what `--listen` takes.
std::string address_to_ask(const std::string& listen);

}  // namespace xr3
