// Every bit of the machine that changes, as one regular value: copy it and you have a snapshot,
// compare it and you know whether two machines are the same. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/units.hpp"

namespace xr3 {

/// One motor with its 8-bit error counter (paper, Section IV, "Move Joint").
struct MotorState {
  Counts count = 0;        ///< its encoder; 0 at the soft home
  std::int16_t phase = 0;  ///< thousandths of the next count, 0...999
  std::int8_t error = 0;   ///< counts still to go; adding wraps
  std::uint8_t speed = 1;  ///< counts a second
  Blocked blocked = Blocked::kNo;
  bool switch_closed = false;
  bool operator==(const MotorState&) const = default;
};

using Motors = std::array<MotorState, kMaxMotors>;  ///< those beyond the model's stay as they begin

/// The line of sight, integers -9...9, not all 0.
struct ViewVector {
  int x = 1;
  int y = 1;
  int z = 1;
  bool operator==(const ViewVector&) const = default;
};

/// What the display and command mode are set to (paper, Tables IV and VII).
struct DisplaySettings {
  bool on = false;
  ViewVector view;
  int period_half_s = 6;
  bool erase = true;
  int status_option = 0;
  bool function_keys = true;
  bool operator==(const DisplaySettings&) const = default;
};

/// Digital lines: bit i is line or port i+1.
struct InputOutput {
  std::uint8_t inputs = 0;
  std::uint8_t outputs = 0;
  std::uint8_t auxiliary = 0;
  bool operator==(const InputOutput&) const = default;
};

/// The one block that the jaws hold. While it is held its entry in State::blocks stays as it was when
/// it was grasped; where it is now follows from that and from the joints (see grasp.hpp).
struct Held {
  std::uint32_t block = 0;  ///< index in State::blocks
  int quarter_turns = 0;    ///< of the block against the jaws: yaw = net roll + 90 deg * this
  Positions grasped_at{};   ///< of the joints when it was grasped
  bool operator==(const Held&) const = default;
};

/// Where the tool tip has been since erasing was turned off: the last kMostTipPoints points.
struct TipPath {
  static constexpr std::size_t kMostTipPoints = 4096;
  std::vector<PointUm> points;  ///< a ring once it is full
  std::size_t oldest = 0;       ///< index of its first point

  /// Adds a point, in place of the oldest where the path is full.
  void add(const PointUm& tip);
  bool operator==(const TipPath&) const = default;
};

struct State {
  Tick tick = 0;
  Motors motors;
  Stall stall = Stall::kNo;
  bool below_surface = false;  ///< the tool tip is under the work surface
  bool enabled = true;
  DisplaySettings display;
  InputOutput io;
  std::vector<Block> blocks;
  std::optional<Held> held;
  bool jaws_warned = false;  ///< jaws_too_narrow was told for the closing that goes on
  TipPath tip_path;
  bool operator==(const State&) const = default;

  MotorState& motor(int index) { return motors[static_cast<std::size_t>(index)]; }
  const MotorState& motor(int index) const { return motors[static_cast<std::size_t>(index)]; }
};

}  // namespace xr3
