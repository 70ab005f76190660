// Measures the peak of memory allocated with operator new, which it replaces in a program that
// links it, or lets it fail. All threads are counted together. ThreadSanitizer keeps an operator
// new of its own, so that nothing is counted: the preset `threads` leaves out the tests concerned.
#pragma once

#include <cstddef>

namespace xr3::test {

/// Measures from its construction. At most one instance may exist at a time.
class Allocations {
 public:
  Allocations();

  /// Maximum number of allocated bytes since construction, minus those allocated at construction.
  std::size_t peak() const;

 private:
  std::size_t before_;
};

/// While it exists, each allocation fails.
class NoMemory {
 public:
  NoMemory();
  NoMemory(const NoMemory&) = delete;
  NoMemory& operator=(const NoMemory&) = delete;
  ~NoMemory();
};

}  // namespace xr3::test
