// The speed of the serial lines: how long a character takes, from the settings of a serial port.
// Exact integers, so that a line takes the same time on every machine.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/sim_clock.hpp"
#include "core/units.hpp"
#include "protocol/line/serial_settings.hpp"

namespace xr3 {

/// Microseconds of simulated time since tick 0 of the epoch.
using Micros = std::int64_t;
inline constexpr Micros kMicrosPerTick = 1'000'000 / kTickHz;

constexpr Micros micros_at(Tick tick) { return tick * kMicrosPerTick; }

/// The first tick at or after this moment. Precondition: the moment is not negative.
constexpr Tick first_tick_after(Micros moment) {
  assert(moment >= 0);
  return moment / kMicrosPerTick + (moment % kMicrosPerTick > 0 ? 1 : 0);
}

/// The speed that all lines of a robot have.
struct LineSpeed {
  std::optional<SerialSettings> settings;  ///< nullopt if the client of the line sets them
  Rate factor;                             ///< characters take the factor-th part of their time

  bool operator==(const LineSpeed&) const = default;
};

/// The time of a character with start, data, parity and stop bits.
class CharacterTime {
 public:
  /// An unknown frame counts as that of the Mark III controller. Precondition: the speed is above
  /// 0.
  CharacterTime(const SerialSettings& settings, Rate factor);

  /// The time of `count` characters, one after the other, rounded down to whole microseconds.
  Micros of(std::int64_t count) const;

  /// The time of one character, rounded to the nearest microsecond; half a microsecond is rounded
  /// up.
  Micros rounded() const;

  bool operator==(const CharacterTime&) const = default;

 private:
  std::int64_t half_micros_of(std::int64_t count) const;

  int half_bits_;
  std::uint32_t baud_;
  Rate factor_;
};

}  // namespace xr3
