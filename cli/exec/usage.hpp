// Memory, processes and files that a program under test uses, as the system counts them.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace xr3 {

struct Usage {
  std::size_t processes = 0;
  std::uint64_t memory_bytes = 0;  ///< pages that several have count in parts; with `files`
  std::uint64_t files = 0;         ///< in the folders of the sandbox
};

/// Sums up these processes. `folders`: those of the sandbox that the program can write to; empty:
/// it has none. A process that ends meanwhile counts as nothing.
Usage usage_of(const std::vector<::pid_t>& processes, const std::vector<std::string>& folders);

}  // namespace xr3
