// The sources of option values that are not arguments, so that error messages can name them.
#pragma once

#include <map>
#include <string>

#include "server/base/exit_code.hpp"

namespace xr3 {

/// Maps an option (`--robot`) to the source of its value (`XR3_ROBOT`); without arguments.
using OptionSources = std::map<std::string, std::string>;

/// The source of the option's value; the option itself if it is an argument.
inline std::string source_of(const OptionSources& option_sources, const std::string& option) {
  const auto place = option_sources.find(option);
  return place == option_sources.end() ? option : place->second;
}

/// Calls `act`. Prefixes the message of a FileError with the source of the option's value, unless
/// that is an argument.
template <class Act>
auto with_option_source(const OptionSources& option_sources, const std::string& option, Act act) {
  try {
    return act();
  } catch (const FileError& error) {
    const auto place = option_sources.find(option);
    if (place == option_sources.end()) throw;
    throw FileError(place->second + ": " + error.what());
  }
}

}  // namespace xr3
