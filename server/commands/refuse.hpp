// The exit of a command that cannot do what its arguments ask.
#pragma once

#include <iostream>
#include <string>

#include "server/exit_code.hpp"

namespace xr3 {

/// Prints the message to standard error.
inline ExitCode refuse(const std::string& message) {
  std::cerr << "xr3: " << message << "\n";
  return ExitCode::kBadInput;
}

}  // namespace xr3
