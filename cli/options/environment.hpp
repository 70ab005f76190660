// Options from environment variables: the variable of each option, and the variable that caused an
// error. An empty variable counts as not set.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <set>
#include <string>

#include "server/base/option_sources.hpp"

namespace xr3 {

/// Lets each option of the command except --help and `except` take its value from a variable unless
/// it is an argument: `--robot-port` from XR3_ROBOT_PORT.
void read_environment(CLI::App& command, const std::set<std::string>& except);

/// Whether the option was given on the command line.
bool is_argument(const CLI::App& command, const std::string& name);

/// Sets the options whose variables CLI11 has not taken: since version 2.4 it skips variables with
/// an invalid value and those with a list. Returns the variables that set options of the command.
/// Throws CLI::ParseError.
OptionSources complete_from_environment(CLI::App& command);

/// The error in a variable's value, prefixed with its name; nullopt if all are valid.
std::optional<std::string> problem_in_environment(CLI::App& command);

/// The error in an option's value, without the option's name.
std::string reason_of(const CLI::Option& option, const CLI::Error& error);

}  // namespace xr3
