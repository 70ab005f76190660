// The error of a system call as an exception.
#pragma once

#include <cerrno>
#include <string>
#include <system_error>

namespace xr3 {

/// Throws the std::system_error of errno; `what` names the failed operation.
[[noreturn]] inline void throw_errno(const std::string& what) {
  throw std::system_error(errno, std::system_category(), what);
}

}  // namespace xr3
