// Wall time to simulated time as pure arithmetic: wall time is an argument, in nanoseconds of any
// steady clock, so that nothing here reads a clock.
#pragma once

#include <cstdint>

#include "core/units.hpp"

namespace xr3 {

/// Nanoseconds of a steady clock that never runs backwards.
using WallNs = std::int64_t;

/// Simulated seconds in a wall second, in millionths, so that it is exact.
struct Rate {
  std::int64_t millionths = 1'000'000;
  bool operator==(const Rate&) const = default;
};
inline constexpr Rate kSlowest{1'000};
inline constexpr Rate kFastest{100'000'000'000};

enum class ClockMode : std::uint8_t { kReal, kManual };

/// A clock that follows wall time at a rate, or stands until it is told.
class SimClock {
 public:
  static SimClock real(Rate rate, WallNs now, Tick tick = 0) {
    return SimClock(ClockMode::kReal, rate, now, tick);
  }
  static SimClock manual(Tick tick = 0) { return SimClock(ClockMode::kManual, Rate{}, 0, tick); }

  ClockMode mode() const { return mode_; }
  Rate rate() const { return rate_; }

  /// The tick at a moment; in manual mode the one at which it stands.
  Tick at(WallNs now) const;

  /// The first moment at which at() gives `tick`; only where the mode is real.
  WallNs when(Tick tick) const;

  void pause(WallNs now);
  void resume(WallNs now);
  void set_rate(Rate rate, WallNs now);
  /// Puts the clock at a tick: after a step in standing time, or in a new epoch.
  void set_tick(Tick tick, WallNs now);

 private:
  SimClock(ClockMode mode, Rate rate, WallNs now, Tick tick)
      : mode_(mode), rate_(rate), since_(now), base_(tick) {}

  ClockMode mode_;
  Rate rate_;
  WallNs since_;  ///< the moment at which the clock showed base_
  Tick base_;
};

}  // namespace xr3
