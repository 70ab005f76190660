// The command line of `xr3 healthcheck`.
#pragma once

#include <cstdint>
#include <string>

#include "cli/options/cli_fwd.hpp"

namespace xr3 {

struct HealthOptions {
  std::string listen = "localhost";   ///< the option --listen of serve
  std::uint16_t monitor_port = 9601;  ///< used without a port file
  std::string port_file;              ///< written by serve; empty if there is none
  double wait_s = 0;                  ///< retry time; 0 for one attempt
  std::string config;                 ///< a config file of serve; empty if there is none
};

/// Adds the subcommand `healthcheck` with its options.
void add_health(CLI::App& app, HealthOptions& options);

/// The address to connect to if serve has this `--listen` address: loopback for a wildcard address.
/// Precondition: check_listen accepts `listen`.
std::string address_to_ask(const std::string& listen);

}  // namespace xr3
