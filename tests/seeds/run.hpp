// One run: a server, its clients and its misfortunes, all from one seed.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "tests/seeds/memory.hpp"

namespace xr3::seeds {

struct RunOptions {
  std::ostream* transcript = nullptr;             ///< of the system calls
  bool chooses_failure = true;                    ///< the seed may choose an allocation that fails
  std::uint64_t failing_allocation = kNoFailure;  ///< otherwise this one, from 0
};

struct Outcome {
  std::string failure;            ///< empty: everything was right
  bool has_served = true;         ///< false: it failed at its start; what Asio has registered stays
  std::string summary;            ///< what happened, in a line
  std::uint64_t digest = 0;       ///< equal for equal runs
  std::uint64_t allocations = 0;  ///< of the server
};

Outcome run_seed(std::uint64_t seed, const RunOptions& options = {});

}  // namespace xr3::seeds
