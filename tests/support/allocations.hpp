// Counts what operator new gives out, in whatever program links this: the most that was held at once while
// something ran. It counts all threads together.
#pragma once

#include <cstddef>

namespace xr3::test {

/// Watches from its construction on.
class Allocations {
 public:
  Allocations();

  /// Most bytes held at once beyond those that were held at the beginning.
  std::size_t peak() const;

 private:
  std::size_t before_;
};

}  // namespace xr3::test
