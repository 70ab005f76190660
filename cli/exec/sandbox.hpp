// The command line that runs a program under bubblewrap: it sees the system's programs and
// libraries, the files that are bound, and nothing else. It has no capabilities, and can write a
// limited amount to /tmp, /dev/shm and the current folder, all of them empty and in memory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/exec/program_user.hpp"
#include "cli/exec/readable.hpp"

namespace xr3 {

/// The path of the program's pseudo-terminal in the sandbox.
inline constexpr const char* kSandboxPty = "/run/xr3/serial";

/// The folder for PYTHONPATH in the sandbox, with the package xr3 in it.
inline constexpr const char* kSandboxPython = "/run/xr3/python";

/// The Python package xr3 that belongs to this program; empty if there is none.
std::string python_package();

/// Requires a working sandbox. Throws FileError if bubblewrap is not installed, or the system does
/// not let `user` make the sandbox; the message ends with `without`, the way to do without it.
void require_sandbox(const std::optional<ProgramUser>& user, const std::string& without);

/// The command with bubblewrap before it. `pty`: the device of its pseudo-terminal; empty for none.
std::vector<std::string> sandboxed(const std::vector<std::string>& command,
                                   const std::vector<Binding>& bindings, const std::string& pty);

}  // namespace xr3
