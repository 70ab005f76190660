#include "cli/exec/program_user.hpp"

#include <pwd.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <limits>

#include "protocol/text/whole_number.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {

// The functions of the C library would wait for threads that this copy of the process does not
// have.
bool ProgramUser::enter() const {
  return ::syscall(SYS_setgroups, 0, nullptr) == 0 &&
         ::syscall(SYS_setresgid, group, group, group) == 0 &&
         ::syscall(SYS_setresuid, user, user, user) == 0;
}

std::optional<ProgramUser> program_user(const std::string& name, bool is_sandboxed,
                                        std::size_t job) {
  const bool is_root = ::geteuid() == 0;
  if (name.empty()) {
    if (!is_root || !is_sandboxed) return std::nullopt;
    const auto own = kFirstProgramUser + static_cast<::uid_t>(job % kProgramUsers);
    return ProgramUser{own, own};
  }
  if (!is_root) throw FileError("--run-as: only root can run a program as another user");
  constexpr ::uid_t kLast = std::numeric_limits<::uid_t>::max() - 1;
  if (const auto number = whole_number<::uid_t>(name, 1, kLast))
    return ProgramUser{*number, *number};
  if (const passwd* found = ::getpwnam(name.c_str()); found != nullptr && found->pw_uid != 0)
    return ProgramUser{found->pw_uid, found->pw_gid};
  throw FileError("--run-as " + name +
                  ": no user but root; name one of this machine, or a number from 1");
}

}  // namespace xr3
