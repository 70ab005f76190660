#include "cli/exec/hide.hpp"

#include <sys/prctl.h>

#include <cstdlib>
#include <cstring>

#include "cli/exec/throw_errno.hpp"
#include "server/options/token.hpp"

namespace xr3 {

void hide_from_programs() {
  if (::prctl(PR_SET_DUMPABLE, 0) != 0) throw_errno("prctl(PR_SET_DUMPABLE)");
  char* token = std::getenv(kTokenVariable);
  if (token == nullptr) return;
  ::explicit_bzero(token, std::strlen(token));
  ::unsetenv(kTokenVariable);
}

}  // namespace xr3
