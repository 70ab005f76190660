// Events of the machine as values, each with the tick at which it happened. Core appends them in
// order; the cell adds the cause (a line or the monitor), and protocol formats them as text.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/faults/fault.hpp"
#include "core/units.hpp"

namespace xr3 {

/// The reason why a motor with a nonzero error counter does not move.
enum class Blocked : std::uint8_t {
  kNo,
  kLimit,  ///< the next count would move a joint past a limit
  kBlock,  ///< the jaws hold a block and cannot close further
};

/// The reason why the robot is stalled. It does not move until it is sent home.
enum class Stall : std::uint8_t { kNo, kProtectedRegion, kWorkSurface };

/// Stable codes of the warnings that core raises.
enum class WarningCode : std::uint8_t {
  kCounterOverflow,
  kNoSuchJoint,
  kBadCameraArgument,
  kJawsTooNarrow,
  kJawsTouch,  ///< closing jaws stopped at the width of `block`: nothing is held
  kBelowSurface,
  /// `block` was released `value` um above block `other`; or, if that is empty, above the work
  /// surface, or the carousel if `label` is that of its motor
  kReleasedInAir,
  /// `block` overlaps `value` blocks; the first one is `other`. If there are none, it overlaps the
  /// carousel, the label of which is `label`
  kBlocksOverlap,
};

/// A move was added to a joint's error counter.
struct MoveTaken {
  char label;
  int counts;
  int error;
  bool operator==(const MoveTaken&) const = default;
};
/// A joint's error counter reached 0 by moving.
struct Reached {
  char label;
  Counts count;
  bool operator==(const Reached&) const = default;
};
/// A motor stopped with a nonzero error counter. `by` is the label of the joint at its limit.
struct MotorBlocked {
  char label;
  Blocked why;
  char by;
  bool upper;    ///< the upper limit of `by`'s variable, not the lower one
  double limit;  ///< degrees or mm; 0 unless `why` is kLimit
  Counts count;
  int error;
  bool operator==(const MotorBlocked&) const = default;
};
struct Stalled {
  Stall why;
  bool operator==(const Stalled&) const = default;
};
struct SwitchChanged {
  char label;
  bool closed;
  Counts count;
  bool operator==(const SwitchChanged&) const = default;
};
struct Grasped {
  std::string block;
  PointUm centroid_um;
  Microdegrees yaw_udeg;
  bool operator==(const Grasped&) const = default;
};
struct Released {
  std::string block;
  PointUm centroid_um;
  Microdegrees yaw_udeg;
  bool operator==(const Released&) const = default;
};
/// The robot was sent to its soft home.
struct Homed {
  bool operator==(const Homed&) const = default;
};
struct OutputChanged {
  int line;  ///< 1...8
  bool high;
  bool operator==(const OutputChanged&) const = default;
};
struct InputChanged {
  int line;  ///< 1...8
  bool high;
  bool operator==(const InputChanged&) const = default;
};
struct AuxiliaryChanged {
  int port;  ///< 1...2
  bool on;
  bool operator==(const AuxiliaryChanged&) const = default;
};
struct EnabledChanged {
  bool enabled;
  bool operator==(const EnabledChanged&) const = default;
};
/// `label` is the joint concerned; the meaning of `value` and `limit` depends on `code`.
struct Warning {
  WarningCode code;
  char label = 0;
  int value = 0;
  int limit = 0;
  std::string block;
  std::string other = {};
  bool operator==(const Warning&) const = default;
};

enum class FaultPhase : std::uint8_t { kSet, kCleared, kBegan, kEnded, kEffect };

/// The begin, end or effect of a fault on demand; see core/faults.
struct FaultNews {
  std::string fault;  ///< name of the fault
  FaultKind kind = FaultKind::kByteDropped;
  FaultPhase phase = FaultPhase::kEffect;
  std::uint64_t effects = 0;  ///< so far, this one included
  char label = 0;             ///< label of the joint concerned; 0 if there is none
  std::int64_t at = 0;        ///< kEffect: the motor's count, or the offset of the byte
  std::uint32_t line = 0;     ///< line_disconnected at a tick: the line, 0 for all
  bool operator==(const FaultNews&) const = default;
};

using EventBody =
    std::variant<MoveTaken, Reached, MotorBlocked, Stalled, SwitchChanged, Grasped, Released, Homed,
                 OutputChanged, InputChanged, AuxiliaryChanged, EnabledChanged, Warning, FaultNews>;

struct Event {
  Tick tick = 0;
  EventBody body;
  bool operator==(const Event&) const = default;
};

using Events = std::vector<Event>;

}  // namespace xr3
