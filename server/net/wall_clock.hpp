// Wall time: nanoseconds of the steady clock. No other clock drives the simulation. The time of day
// is only shown.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

#include "core/sim_clock.hpp"

namespace xr3 {

inline WallNs wall_now() {
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since_start).count();
}

/// The time of day, to be shown: milliseconds since 1970 in UTC.
inline std::int64_t unix_ms() {
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(since_1970).count();
}

/// Sentinel: never.
inline constexpr WallNs kNever = std::numeric_limits<WallNs>::max();

/// Converts a moment for Asio's steady timers.
inline std::chrono::steady_clock::time_point as_time_point(WallNs moment) {
  const std::chrono::nanoseconds since_start{moment};
  return std::chrono::steady_clock::time_point{
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(since_start)};
}

}  // namespace xr3
