// Converts wall time to simulated time, as pure arithmetic: wall time is always an argument, in
// nanoseconds of any steady clock.
#pragma once

#include <cstdint>

#include "core/units.hpp"

namespace xr3 {

/// Nanoseconds of a steady clock that never runs backwards.
using WallNs = std::int64_t;

/// Simulated seconds per wall second, in millionths, so that it is exact.
struct Rate {
  std::int64_t millionths = 1'000'000;
  bool operator==(const Rate&) const = default;
};
inline constexpr Rate kSlowest{1'000};
inline constexpr Rate kFastest{100'000'000'000};

enum class ClockMode : std::uint8_t {
  kReal,    ///< follows wall time
  kManual,  ///< advanced by calls
  kBytes,   ///< advanced by the bytes of the lines
};

/// A simulation clock. In real mode it follows wall time at a rate; in the other modes only
/// set_tick() advances it.
class SimClock {
 public:
  static SimClock real(Rate rate, WallNs now, Tick tick = 0) {
    return SimClock(ClockMode::kReal, rate, now, tick);
  }
  static SimClock manual(Tick tick = 0) { return SimClock(ClockMode::kManual, Rate{}, 0, tick); }
  static SimClock bytes(Tick tick = 0) { return SimClock(ClockMode::kBytes, Rate{}, 0, tick); }

  ClockMode mode() const { return mode_; }
  /// The mode to which resume() returns: kBytes if the clock was made so, else kReal.
  ClockMode running_mode() const { return running_mode_; }
  Rate rate() const { return rate_; }

  /// The tick at wall time `now`; except in real mode the current tick for any `now`.
  Tick at(WallNs now) const;

  /// The first wall time at which at() returns `tick`. Real mode only.
  WallNs when(Tick tick) const;

  /// Switches to manual mode at the current tick.
  void pause(WallNs now);
  /// Switches to running_mode(), continuing from the current tick.
  void resume(WallNs now);
  /// Changes the rate from the current tick on; the mode stays. Precondition: running_mode() is
  /// kReal.
  void set_rate(Rate rate, WallNs now);
  /// Sets the current tick: after a step, after bytes, or in a new epoch.
  void set_tick(Tick tick, WallNs now);

  bool operator==(const SimClock&) const = default;

 private:
  SimClock(ClockMode mode, Rate rate, WallNs now, Tick tick)
      : mode_(mode),
        running_mode_(mode == ClockMode::kBytes ? ClockMode::kBytes : ClockMode::kReal),
        rate_(rate),
        since_(now),
        base_(tick) {}

  ClockMode mode_;
  ClockMode running_mode_;
  Rate rate_;
  WallNs since_;  ///< wall time at which the tick was base_
  Tick base_;
};

}  // namespace xr3
