// The ends of commands that cannot do what they should.
#pragma once

#include <csignal>
#include <iostream>
#include <string>

#include "server/exit_code.hpp"

namespace xr3 {

/// Prints the message to standard error.
inline ExitCode fail(ExitCode code, const std::string& message) {
  std::cerr << "xr3: " << message << "\n";
  return code;
}

/// A broken connection, or a file that reaches its limit, is an error of the call, not the end.
inline void ignore_signals_of_writing() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace xr3
