// The command line that runs a program under bubblewrap: it sees the system's programs and
// libraries, the files that its command names, and nothing else. It has no capabilities, and can
// write a limited amount to /tmp, /dev/shm and the current folder, all of them empty and in memory.
#pragma once

#include <string>
#include <vector>

namespace xr3 {

/// Where the program finds its pseudo-terminal in the sandbox.
inline constexpr const char* kSandboxPty = "/run/xr3/serial";

/// Whether bubblewrap is installed.
bool has_sandbox();

/// The command with bubblewrap before it. `readable`: further files and folders, which it can read;
/// `pty`: the device of its pseudo-terminal.
std::vector<std::string> sandboxed(const std::vector<std::string>& command,
                                   const std::vector<std::string>& readable,
                                   const std::string& pty);

}  // namespace xr3
