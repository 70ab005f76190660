// The exit codes of xr3, as `xr3 --help` lists them.
#pragma once

namespace xr3 {

enum class ExitCode : int {
  kGood = 0,
  kInternal = 1,   ///< a bug, or the system refused something vital
  kBadInput = 2,   ///< wrong arguments, or a wrong file
  kPortInUse = 3,  ///< somebody else listens there already
  kNoServer = 4,   ///< nobody answers there, or it is not ready
  kBroken = 5,     ///< something failed while the server ran; the log names it
};

constexpr int as_int(ExitCode code) { return static_cast<int>(code); }

}  // namespace xr3
