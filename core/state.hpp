// The complete mutable state of the machine as one regular value: a copy is a snapshot, and ==
// compares two machines. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/event.hpp"
#include "core/faults/fault_state.hpp"
#include "core/model.hpp"
#include "core/shared_vector.hpp"
#include "core/units.hpp"

namespace xr3 {

/// One motor with its 8-bit error counter (paper, Section IV, "Move Joint").
struct MotorState {
  Counts count = 0;        ///< encoder count; 0 at the soft home
  std::int16_t phase = 0;  ///< thousandths of the next count, 0...999
  std::int8_t error = 0;   ///< counts still to go; addition wraps
  std::uint8_t speed = 1;  ///< counts per second
  Blocked blocked = Blocked::kNo;
  bool switch_closed = false;
  bool operator==(const MotorState&) const = default;
};

/// The motor has counts to go and is not blocked.
inline bool is_running(const MotorState& motor) {
  return motor.error != 0 && motor.blocked == Blocked::kNo;
}

/// Elements beyond the model's motors keep their initial value.
using Motors = std::array<MotorState, kMaxMotors>;

/// The line of sight, integers -9...9, not all 0.
struct ViewVector {
  int x = 1;
  int y = 1;
  int z = 1;
  bool operator==(const ViewVector&) const = default;
};

/// Settings of the display and of command mode (paper, Tables IV and VII).
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

/// The block in the jaws. While it is held, its entry in State::blocks keeps the pose at which it
/// was grasped; block_pose() in grasp.hpp computes its current pose from that and the joints.
struct Held {
  std::uint32_t block = 0;  ///< index in State::blocks
  /// Turns of the block relative to the jaws: yaw = net roll + 90 deg * this.
  int quarter_turns = 0;
  Positions grasped_at{};  ///< joint positions when the block was grasped
  bool operator==(const Held&) const = default;
};

/// A block on the carousel: where it was put, and at which count of the carousel. Its entry in
/// State::blocks follows the carousel: see as_turned() in carousel.hpp.
struct Rider {
  std::uint32_t block = 0;  ///< index in State::blocks
  Counts count = 0;
  PointUm centroid_um;
  Microdegrees yaw_udeg = 0;
  bool operator==(const Rider&) const = default;
};

/// The path of the tool tip since erasing was turned off: the last kMaxTipPoints points.
struct TipPath {
  static constexpr std::size_t kMaxTipPoints = 4096;
  SharedVector<PointUm> points;  ///< a ring buffer once it is full
  std::size_t oldest = 0;        ///< index of the oldest point

  /// Adds a point; overwrites the oldest if the path is full.
  void add(const PointUm& tip) {
    if (points.size() < kMaxTipPoints) return points.edit().push_back(tip);
    points.edit()[oldest] = tip;
    oldest = (oldest + 1) % kMaxTipPoints;
  }
  bool operator==(const TipPath&) const = default;
};

/// The version of State in digests. It changes with the members of State and with their meaning, so
/// that digests of other versions of xr3 are not compared.
inline constexpr int kStateFormat = 1;

struct State {
  Tick tick = 0;
  Motors motors;
  Stall stall = Stall::kNo;
  bool below_surface = false;  ///< the tool tip is below the work surface
  bool enabled = true;
  DisplaySettings display;
  InputOutput io;
  SharedVector<Block> blocks;
  std::optional<Held> held;
  std::vector<Rider> riders;  ///< in the order of their blocks; none without a carousel
  bool jaws_warned = false;   ///< jaws_too_narrow was already reported for the current closing
  TipPath tip_path;
  Faults faults;
  bool operator==(const State&) const = default;

  MotorState& motor(int index) { return motors[static_cast<std::size_t>(index)]; }
  const MotorState& motor(int index) const { return motors[static_cast<std::size_t>(index)]; }
};

/// Whether the jaws hold this block.
inline bool is_held(const State& state, std::size_t block) {
  return state.held && state.held->block == block;
}

}  // namespace xr3
