// What the machine has to tell, as values with the tick at which it happened. Core appends them in
// order; who asked for it (a line, the monitor) is added by the cell, and the words by protocol.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/units.hpp"

namespace xr3 {

/// Why a motor with work to do stands still.
enum class Blocked : std::uint8_t {
  kNo,
  kLimit,  ///< its next count would take a joint past a limit
  kBlock,  ///< the jaws stand against a block
};

/// Why nothing moves until the robot is sent home.
enum class Stall : std::uint8_t { kNo, kProtectedRegion, kWorkSurface };

/// Stable codes of warnings that the machine itself raises.
enum class WarningCode : std::uint8_t {
  kCounterOverflow,
  kNoSuchJoint,
  kBadCameraArgument,
  kJawsTooNarrow,
  kBelowSurface,
};

/// A move was added to a joint's error counter.
struct MoveTaken {
  char label;
  int counts;
  int error;
  bool operator==(const MoveTaken&) const = default;
};
/// A joint's error counter came to 0 by moving.
struct Reached {
  char label;
  Counts count;
  bool operator==(const Reached&) const = default;
};
/// A motor came to stand with its error counter not 0. `by` is the joint whose limit it is.
struct MotorBlocked {
  char label;
  Blocked why;
  char by;
  bool upper;    ///< the limit at the high end of `by`'s variable
  double limit;  ///< degrees or mm; 0 where it is not a limit
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
/// Something surprising; `label` is the joint concerned, `value` and `limit` what the code needs.
struct Warning {
  WarningCode code;
  char label = 0;
  int value = 0;
  int limit = 0;
  std::string block;
  bool operator==(const Warning&) const = default;
};

using EventBody =
    std::variant<MoveTaken, Reached, MotorBlocked, Stalled, SwitchChanged, Grasped, Released, Homed,
                 OutputChanged, InputChanged, AuxiliaryChanged, EnabledChanged, Warning>;

struct Event {
  Tick tick = 0;
  EventBody body;
  bool operator==(const Event&) const = default;
};

using Events = std::vector<Event>;

}  // namespace xr3
