// Times of messages in nanoseconds. The live server counts them from the start of an epoch; a file
// lays epochs one after the other, since its messages are in the order of their times.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <optional>

#include "core/units.hpp"
#include "protocol/explain/cell_event.hpp"

namespace xr3::foxglove {

using Nanoseconds = std::uint64_t;

/// The time of a tick since the start of its epoch.
constexpr Nanoseconds since_epoch(Tick tick) {
  constexpr Nanoseconds kPerTick = 1'000'000'000 / kTickHz;
  return static_cast<Nanoseconds>(tick) * kPerTick;
}

/// Lays epochs one after the other: each begins a tick after the last moment of the one before.
class Timeline {
 public:
  /// The time of a tick, counted from tick 0 of the first epoch. Precondition: calls are in the
  /// order in which the moments happened.
  Nanoseconds at(Epoch epoch, Tick tick) {
    if (epoch_ && *epoch_ != epoch) offset_ = last_ + 1 - tick;
    epoch_ = epoch;
    assert(tick + offset_ >= last_);
    last_ = tick + offset_;
    return since_epoch(last_);
  }

 private:
  std::optional<Epoch> epoch_;  ///< nullopt before the first call
  Tick offset_ = 0;             ///< between a tick of the epoch and one of the timeline
  Tick last_ = 0;
};

}  // namespace xr3::foxglove
