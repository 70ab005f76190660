// Replaces operator new: counts the bytes that the server holds, and lets one of its allocations
// fail. The test's own allocations, inside an Outside, are not counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace xr3::seeds {

inline constexpr std::uint64_t kNoFailure = std::numeric_limits<std::uint64_t>::max();

/// While it exists, this thread allocates for the test, not for the server.
class Outside {
 public:
  Outside();
  Outside(const Outside&) = delete;
  Outside& operator=(const Outside&) = delete;
  ~Outside();
};

/// Within an Outside, for code of the server that the test calls.
class Inside {
 public:
  Inside();
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
  ~Inside();

 private:
  int depth_;
};

/// Counts the server's allocations from now on, and lets `count` of them fail, the first one after
/// `before` others.
void start_counting(std::uint64_t before = kNoFailure, std::uint64_t count = 1);

/// The number of allocations since start_counting(), and how many of them failed.
std::uint64_t allocation_count();
std::uint64_t failed_allocations();
/// Prints the stack of each failing allocation, if the build can.
void show_failing_stacks(bool show);

/// Bytes that the server holds now, and the maximum since start_counting().
std::int64_t held_bytes();
std::int64_t peak_bytes();

}  // namespace xr3::seeds
