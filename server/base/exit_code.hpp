// The exit codes of xr3, as `xr3 --help` lists them, and the errors that end a command.
#pragma once

#include <stdexcept>
#include <string>

namespace xr3 {

enum class ExitCode : int {
  kGood = 0,
  kInternal = 1,       ///< a bug, or a required system call failed
  kBadInput = 2,       ///< invalid arguments, or an invalid file
  kPortInUse = 3,      ///< another program has the port or device
  kNoServer = 4,       ///< no server or robot answers, or it is not ready
  kBroken = 5,         ///< the server failed while it ran; the log has the reason
  kGoalsMissed = 5,    ///< `xr3 exec`: the program ended, and missed a goal
  kProgramFailed = 6,  ///< `xr3 exec`: the program could not be started, or failed
  kTimeUp = 7,         ///< `xr3 exec`: a limit was reached
  kDifferent = 8,      ///< a replay differs from its recording, or repeated runs from each other
};

constexpr int as_int(ExitCode code) { return static_cast<int>(code); }

/// An error that ends a command; the message says why and what to do.
class ExitError : public std::runtime_error {
 public:
  ExitError(ExitCode code, const std::string& what) : std::runtime_error(what), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// A file that cannot be found, read or written; the message names the file and the reason.
class FileError : public ExitError {
 public:
  explicit FileError(const std::string& what) : ExitError(ExitCode::kBadInput, what) {}
};

}  // namespace xr3
