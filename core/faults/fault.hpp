// A fault on demand as a value: what it does, to what, when and for how long. Independent of files
// and of the state; see fault_state.hpp for the faults of a machine and docs/faults.md for each
// kind.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/units.hpp"

namespace xr3 {

enum class FaultKind : std::uint8_t {
  kByteDropped,
  kByteFlipped,
  kByteDoubled,
  kStrayByte,
  kParityError,
  kWrongBaud,
  kWrongParity,
  kReplyLost,
  kReplyDelayed,
  kReplyBatched,
  kXoffStall,
  kLineDisconnected,
  kPowerCycle,
  kMotorStuck,
  kMotorSlow,
  kEncoderSlip,
  kGripSlip,
  kSwitchStuckOpen,
  kSwitchStuckClosed,
  kSwitchBouncing,
  kCameraNoise,
  kCameraDeadRow,
  kCameraOffset,
};
inline constexpr std::size_t kFaultKinds = static_cast<std::size_t>(FaultKind::kCameraOffset) + 1;

/// The part of the simulation on which a fault acts.
enum class FaultTarget : std::uint8_t { kLine, kController, kJoint, kJaws, kCamera };

/// The time at which a fault has its effect.
enum class FaultManner : std::uint8_t {
  kLasting,  ///< from its first tick until its last; both are stops of the advance of time
  kEffects,  ///< each time that there is an occasion: a byte, a reply, a count
  kOnce,     ///< at one tick, a stop of the advance of time
};

/// The direction of bytes on a line.
enum class LineSide : std::uint8_t { kIn, kOut };

/// The properties of a kind.
struct FaultTraits {
  FaultTarget target;
  FaultManner manner;
  bool has_after_bytes;   ///< allows the trigger after_bytes
  bool has_probability;   ///< allows the trigger probability
  bool is_once_at_first;  ///< with at_tick or after_bytes alone, it has one effect
};
const FaultTraits& traits_of(FaultKind kind);

/// Every probability is this many parts.
inline constexpr std::uint32_t kCertain = 1'000'000'000;
/// Sentinel: never.
inline constexpr Tick kNoTick = INT64_MAX;

/// One of at_tick, from_tick, after_bytes and chance is the trigger; from_tick may also delay a
/// chance.
struct Fault {
  static constexpr std::size_t kMaxName = 32;
  static constexpr std::uint32_t kMaxDelayMs = 60'000;
  static constexpr std::uint32_t kMaxPeriodMs = 1'000;
  static constexpr std::uint32_t kMaxBounceMs = 1'000;
  static constexpr std::uint32_t kUsualPeriodMs = 16;
  static constexpr std::uint32_t kUsualBounceMs = 20;
  static constexpr std::int64_t kMaxTicks = (std::int64_t{1} << 53) - 1;

  std::string name;
  FaultKind kind = FaultKind::kByteDropped;

  std::uint32_t line = 0;  ///< number of the line; 0 for any
  LineSide direction = LineSide::kIn;
  char joint = 0;                            ///< label of the joint
  std::optional<int> bit{};                  ///< byte_flipped: 0...7; nullopt if chosen by chance
  std::uint8_t byte = 0;                     ///< stray_byte
  std::uint32_t percent = 0;                 ///< motor_slow: of its speed, 1...99
  std::uint32_t delay_ms = 0;                ///< reply_delayed
  std::uint32_t period_ms = kUsualPeriodMs;  ///< reply_batched
  std::uint32_t bounce_ms = kUsualBounceMs;  ///< switch_bouncing
  int row = 0;                               ///< camera_dead_row
  int columns = 0;                           ///< camera_offset: to the right
  int rows = 0;                              ///< camera_offset: downwards

  std::optional<Tick> at_tick{};
  std::optional<Tick> from_tick{};
  std::optional<std::uint64_t> after_bytes{};
  std::optional<std::uint32_t> chance{};  ///< 1...kCertain
  std::optional<Tick> ticks{};            ///< duration
  std::optional<std::uint32_t> count{};   ///< number of effects

  bool operator==(const Fault&) const = default;

  /// The first tick at which the fault can have an effect.
  Tick begin() const { return at_tick ? *at_tick : from_tick.value_or(0); }
  /// The first tick at which the fault has ended.
  Tick end() const { return ticks ? begin() + *ticks : kNoTick; }
  bool covers(Tick tick) const { return begin() <= tick && tick < end(); }
  /// The maximum number of effects.
  std::uint64_t limit() const;
};

/// Whether it acts as long as it covers the tick.
bool lasts(const Fault& fault);
/// Whether it acts at its first tick, without an occasion.
bool is_timed(const Fault& fault);

/// The contents of a fault file.
struct FaultPlan {
  std::uint64_t seed = 0;
  std::vector<Fault> faults;
  std::string notes = {};
  bool operator==(const FaultPlan&) const = default;
};

/// Maximum number of faults of a machine. Each byte and each count looks at all of them.
inline constexpr std::size_t kMaxFaults = 32;

}  // namespace xr3
