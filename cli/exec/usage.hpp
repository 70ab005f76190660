// Memory, processes and files of a program under test, as the system counts them.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace xr3 {

struct Usage {
  std::size_t processes = 0;
  std::uint64_t memory_bytes = 0;  ///< a page shared by several counts in parts; includes `files`
  std::uint64_t files = 0;         ///< in the folders of the sandbox
};

/// Sums up these processes. `folders`: those of the sandbox that the program can write to; empty if
/// there are none. A process that ends meanwhile counts as nothing.
Usage usage_of(const std::vector<::pid_t>& processes, const std::vector<std::string>& folders);

}  // namespace xr3
