#include "tests/fuzz/common/fuzz.hpp"

#include <cstdio>
#include <cstdlib>

#include "tests/support/allocations.hpp"

namespace xr3::fuzz {
namespace {

constexpr std::size_t kMaxAllocated = 64UL * 1024 * 1024;

}  // namespace

void require(bool holds, const char* property) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", property);
  std::abort();
}

void run_within_limits(std::string_view input) {
  const test::Allocations allocations;
  run(input);
  require(allocations.peak() <= kMaxAllocated, "an input needs at most 64 MiB");
}

}  // namespace xr3::fuzz
