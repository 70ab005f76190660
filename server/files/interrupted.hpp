// System calls that a signal may interrupt.
#pragma once

#include <sys/types.h>

#include <cerrno>

namespace xr3 {

/// Repeats a system call while signals interrupt it. Returns its result; errno tells an error.
template <class Call>
::ssize_t retry_interrupted(const Call& call) {
  ::ssize_t count = call();
  while (count < 0 && errno == EINTR) count = call();
  return count;
}

}  // namespace xr3
