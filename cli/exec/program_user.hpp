// The user as whom a judge that is root runs a program, so that the program cannot access files of
// root.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <optional>
#include <string>

namespace xr3 {

struct ProgramUser {
  ::uid_t user;
  ::gid_t group;

  /// Changes this process to the user, without other groups. Only async-signal-safe calls. Returns
  /// whether it succeeded.
  bool enter() const;
};

/// First of the users that have no name, as systemd gives them to services (DynamicUser).
inline constexpr ::uid_t kFirstProgramUser = 61'184;
inline constexpr std::size_t kProgramUsers = 4096;

/// The user for a program: `name`, a name or a number; if it is empty, one of the job's own for a
/// judge that is root and uses the sandbox; nullopt for the judge's user. Throws FileError for an
/// unknown user, or if this process may not become one.
std::optional<ProgramUser> program_user(const std::string& name, bool is_sandboxed,
                                        std::size_t job);

}  // namespace xr3
