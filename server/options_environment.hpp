// Options that may come from the environment: which variable each takes, and which one is to blame for
// an error. An empty variable counts as not set. Only options*.cpp and the like include this.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <set>
#include <string>

#include "server/origins.hpp"

namespace xr3 {

/// Each option of the command, but for --help and these, takes its value from a variable where no
/// argument says it: `--robot-port` from XR3_ROBOT_PORT.
void take_environment(CLI::App& command, const std::set<std::string>& except);

/// Whether the option was said on the command line, and not elsewhere.
bool is_argument(const CLI::App& command, const std::string& name);

/// The variables that gave values to the command.
Origins origins_in_environment(const CLI::App& command);

/// What is wrong with the value of a variable, beginning with its name; nothing where none is wrong.
std::optional<std::string> trouble_in_environment(CLI::App& command);

/// What is wrong with an option's value, without the option's name.
std::string reason_of(const CLI::Option& option, const CLI::Error& error);

}  // namespace xr3
