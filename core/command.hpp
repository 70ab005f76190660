// The controller's commands and replies as values: the commands of the paper's Tables VI and VII
// and those of the Rhino Mark III. Protocol converts them from and to bytes.
#pragma once

#include <cstdint>
#include <type_traits>
#include <variant>

#include "core/image.hpp"

namespace xr3 {

/// Values without members are equal.
template <class Value>
  requires std::is_empty_v<Value>
constexpr bool operator==(const Value& /*a*/, const Value& /*b*/) {
  return true;
}

// --- Replies. Each inquiry names the type of its reply: Answer.

/// Reply to `a?`: |error counter|, 0...128.
struct ErrorMagnitude {
  int counts;
  bool operator==(const ErrorMagnitude&) const = default;
};
/// Reply to `aT`.
struct SignedError {
  std::int8_t counts;
  bool operator==(const SignedError&) const = default;
};
/// Reply to `aV`.
struct SwitchState {
  bool closed;
  bool operator==(const SwitchState&) const = default;
};
/// Reply to `I`, `J`, `K`: the bits of closed switches and, separately, of high input lines.
/// `fitted` has the bits of all switches that the robot has.
struct SwitchBits {
  std::uint8_t closed = 0;
  std::uint8_t fitted = 0;
  std::uint8_t inputs = 0;
  char inquiry = 'I';  ///< 'I', 'J' or 'K'
  bool operator==(const SwitchBits&) const = default;
};
/// Reply to `A**` and `A*r*`: the complete image or one row.
struct CameraRows {
  ImagePtr image;  ///< never null
  bool operator==(const CameraRows& other) const { return *image == *other.image; }
};
/// Reply to `A*c,r*`.
struct PixelValue {
  bool set;
  bool operator==(const PixelValue&) const = default;
};

// --- Motion and inquiry (paper, Table VI). Labels are 'A'...'H'.

/// Adds counts to the joint's error counter.
struct Move {
  static constexpr int kMin = -128;
  static constexpr int kMax = 127;
  char label;
  int counts;
  bool operator==(const Move&) const = default;
};
struct SetSpeed {
  static constexpr int kMin = 1;
  static constexpr int kMax = 255;
  char label;
  int counts_per_s;
  bool operator==(const SetSpeed&) const = default;
};
/// Sets the error counter to 0.
struct Stop {
  char label;
  bool operator==(const Stop&) const = default;
};
/// `a?`: the distance still to go.
struct QueryError {
  using Answer = ErrorMagnitude;
  char label;
  bool operator==(const QueryError&) const = default;
};
/// `aT`: the error counter with its sign.
struct QuerySignedError {
  using Answer = SignedError;
  char label;
  bool operator==(const QuerySignedError&) const = default;
};
/// `aV`: the joint's microswitch.
struct QuerySwitch {
  using Answer = SwitchState;
  char label;
  bool operator==(const QuerySwitch&) const = default;
};
/// `I`: switches of joints C...H.
struct QuerySwitchesI {
  using Answer = SwitchBits;
};
/// `J`: switches of joints A and B, input lines 5-8.
struct QuerySwitchesJ {
  using Answer = SwitchBits;
};
/// `K`: input lines 1-4.
struct QueryInputs {
  using Answer = SwitchBits;
};
/// `L M N O`: auxiliary port 1 or 2 on or off.
struct SetAuxiliary {
  static constexpr int kPorts = 2;
  int port;
  bool on;
  bool operator==(const SetAuxiliary&) const = default;
};
/// `Pn`, `Rn`: output line 1...8 high or low.
struct SetOutput {
  static constexpr int kLines = 8;
  int line;
  bool high;
  bool operator==(const SetOutput&) const = default;
};
/// `Q`: sets error counters to 0, outputs and ports off, and speeds to those of the file; no
/// homing.
struct ControllerReset {};

// --- Environment (paper, Table VII).

struct ToggleDisplay {};
/// Integers -kMax...kMax, not all 0.
struct SetViewVector {
  static constexpr int kMax = 9;
  int x;
  int y;
  int z;
  bool operator==(const SetViewVector&) const = default;
};
/// `A$`: moves joints and tool to the file's home values and clears a stall.
struct SoftHome {};
/// `A@`: enables or disables the simulator.
struct ToggleSimulator {};
/// `A.x`: the refresh period in half seconds.
struct SetRefreshPeriod {
  static constexpr int kMin = 1;
  static constexpr int kMax = 255;
  int half_seconds;
  bool operator==(const SetRefreshPeriod&) const = default;
};
/// `A|`: toggles erasing before redrawing.
struct ToggleErasing {};
/// `A%n`: status line option 0...kMax.
struct SelectStatus {
  static constexpr int kMax = 6;
  int option;
  bool operator==(const SelectStatus&) const = default;
};
/// Command mode's Alt F6: function keys on or off. It has no bytes on a line.
struct ToggleFunctionKeys {};
/// `A**`: the complete binary image.
struct CameraImage {
  using Answer = CameraRows;
};
/// `A*r*`: one row, from 0 at the top.
struct CameraRow {
  using Answer = CameraRows;
  int row;
  bool operator==(const CameraRow&) const = default;
};
/// `A*c,r*`: one pixel.
struct CameraPixel {
  using Answer = PixelValue;
  int column;
  int row;
  bool operator==(const CameraPixel&) const = default;
};

using Command = std::variant<Move, SetSpeed, Stop, QueryError, QuerySignedError, QuerySwitch,
                             QuerySwitchesI, QuerySwitchesJ, QueryInputs, SetAuxiliary, SetOutput,
                             ControllerReset, ToggleDisplay, SetViewVector, SoftHome,
                             ToggleSimulator, SetRefreshPeriod, ToggleErasing, SelectStatus,
                             ToggleFunctionKeys, CameraImage, CameraRow, CameraPixel>;

/// A command with a reply, of the type that it names.
template <class Each>
concept Inquiry = requires { typename Each::Answer; };

/// Whether a command has a reply, if its joint exists.
inline bool is_inquiry(const Command& command) {
  return std::visit([]<class Each>(const Each&) { return Inquiry<Each>; }, command);
}

struct NoReply {};
/// The replies, with `Rows` for rows of the camera's image.
template <class Rows>
using ReplyWith =
    std::variant<NoReply, ErrorMagnitude, SignedError, SwitchState, SwitchBits, Rows, PixelValue>;
using Reply = ReplyWith<CameraRows>;

}  // namespace xr3
