// Where the values of options were found that no argument says, so that an error can name the place.
#pragma once

#include <map>
#include <string>

#include "server/data_files.hpp"

namespace xr3 {

/// From an option (`--robot`) to the place that says it (`XR3_ROBOT`); arguments are not in it.
using Origins = std::map<std::string, std::string>;

/// The place that says it, or the option itself.
inline std::string said_as(const Origins& origins, const std::string& option) {
  const auto place = origins.find(option);
  return place == origins.end() ? option : place->second;
}

/// Does something with the option's file. What is wrong with that begins with the place that says
/// it, unless that is an argument.
template <class Act>
auto blaming(const Origins& origins, const std::string& option, Act act) {
  try {
    return act();
  } catch (const FileError& error) {
    const auto place = origins.find(option);
    if (place == origins.end()) throw;
    throw FileError(place->second + ": " + error.what());
  }
}

}  // namespace xr3
