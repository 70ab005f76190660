// Pipes.
#pragma once

#include <fcntl.h>

#include <array>

#include "cli/exec/throw_errno.hpp"
#include "server/files/descriptor.hpp"

namespace xr3 {

/// Both ends are closed in other programs. The constructor throws std::system_error.
struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw_errno("pipe");
    reading = Descriptor(ends[0]);
    writing = Descriptor(ends[1]);
  }

  Descriptor reading;
  Descriptor writing;
};

}  // namespace xr3
