// Wall time: nanoseconds of the steady clock. No other clock drives the simulation.
#pragma once

#include <chrono>
#include <limits>

#include "core/sim_clock.hpp"

namespace xr3 {

inline WallNs wall_now() {
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since_start).count();
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
