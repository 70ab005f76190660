// The command line that runs a program under bubblewrap: it sees the system's programs and
// libraries, the files that its command names, and nothing else. It has no capabilities, and can
// write a limited amount to /tmp, /dev/shm and the current folder, all of them empty and in memory.
#pragma once

#include <string>
#include <vector>

namespace xr3 {

struct SandboxSettings {
  std::vector<std::string> readable;  ///< further files and folders, which it can read
  std::string pty;                    ///< the device of its pseudo-terminal
};

/// Where the program finds its pseudo-terminal in the sandbox.
inline constexpr const char* kSandboxPty = "/run/xr3/serial";

/// Whether bubblewrap is installed.
bool has_sandbox();

/// The command with bubblewrap before it.
std::vector<std::string> sandboxed(const std::vector<std::string>& command,
                                   const SandboxSettings& settings);

}  // namespace xr3
