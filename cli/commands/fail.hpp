// The ends of commands that fail.
#pragma once

#include <csignal>
#include <string>

#include "protocol/text/printable.hpp"
#include "server/base/exit_code.hpp"
#include "server/print.hpp"

namespace xr3 {

/// Prints the message as one line to standard error.
inline ExitCode fail(ExitCode code, const std::string& message) {
  print_error("xr3: " + printable_line(message) + "\n");
  return code;
}

/// Ignores signals of writing: a broken connection, or a file that reaches its limit, is then an
/// error of the call instead of the end of the process.
inline void ignore_signals_of_writing() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace xr3
