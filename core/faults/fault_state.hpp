// The faults of a machine, as a part of its state: each with its effects so far, and a summary of
// those in force for the code that runs at every tick. Without faults, `all` is empty and the
// summary has its initial value.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/faults/fault.hpp"
#include "core/robot.hpp"

namespace xr3 {

inline constexpr std::uint8_t kFullSpeed = 100;

/// A fault with its history.
struct FaultState {
  Fault fault;
  std::uint64_t effects = 0;
  std::optional<Tick> bounce_tick =
      std::nullopt;        ///< switch_bouncing: the last change of the switch
  Tick news_second = 0;    ///< the simulated second of the last event of an effect
  std::uint32_t news = 0;  ///< the number of such events in that second
  bool is_on = false;      ///< derived: it lasts at this tick
  std::uint64_t salt = 0;  ///< derived: see chance.hpp
  bool operator==(const FaultState&) const = default;

  bool is_spent() const { return effects >= fault.limit(); }
};

/// Bit i is motor i.
using MotorBits = std::uint8_t;
static_assert(kMaxMotors <= 8, "one bit of MotorBits for each motor");
inline constexpr MotorBits kAllMotors = 0xff;

constexpr MotorBits bit_of(int motor) {
  return static_cast<MotorBits>(1U << static_cast<unsigned>(motor));
}
constexpr bool has_motor(MotorBits bits, int motor) {
  return (bits >> static_cast<unsigned>(motor) & 1U) != 0;
}

/// Derived from the faults and the tick: see refresh_faults().
struct FaultsInForce {
  /// Per motor: the percentage of its own speed.
  std::array<std::uint8_t, kMaxMotors> speed_percent = full_speed();
  MotorBits stuck_for_good = 0;  ///< 0 per cent without an end
  MotorBits slipping = 0;        ///< a fault may lose counts of their encoders
  MotorBits open = 0;            ///< switches that are stuck
  MotorBits closed = 0;
  MotorBits bouncing = 0;
  bool on_lines = false;     ///< some fault concerns a line
  bool on_grip = false;      ///< some fault may open the jaws' grip
  bool on_camera = false;    ///< a fault of the camera is in force
  Tick next_stop = kNoTick;  ///< the next tick at which a fault begins or ends
  bool operator==(const FaultsInForce&) const = default;

  static constexpr std::array<std::uint8_t, kMaxMotors> full_speed() {
    std::array<std::uint8_t, kMaxMotors> percents{};
    percents.fill(kFullSpeed);
    return percents;
  }
};

struct Faults {
  std::uint64_t seed = 0;
  std::vector<FaultState> all;     ///< in the order in which they were set
  std::uint32_t power_cycles = 0;  ///< number so far; lines discard an incomplete command at each
  MotorBits slipped = 0;           ///< motors whose last count was lost
  FaultsInForce now;
  bool operator==(const Faults&) const = default;
};

}  // namespace xr3
