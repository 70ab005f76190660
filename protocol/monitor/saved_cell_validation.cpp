// Validates a saved cell: whether a machine with a robot can reach it. Declared in saved_cell.hpp.
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "core/camera.hpp"
#include "core/coupling.hpp"
#include "core/derived_state.hpp"
#include "core/grasp.hpp"
#include "core/kinematics.hpp"
#include "core/stall.hpp"
#include "protocol/monitor/request_error.hpp"
#include "protocol/monitor/saved_cell.hpp"

namespace xr3::monitor {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// The position of a joint or the tool; 64 bits, since these counts are unchecked.
std::int64_t wide_position(const Model& model, const Motors& motors, int index) {
  std::int64_t sum = 0;
  for (int motor = 0; motor < model.motor_count(); ++motor) {
    sum += std::int64_t{model.gain(index, motor)} * motors[at(motor)].count;
  }
  return sum;
}

bool is_within(const MotorModel& motor, std::int64_t position) {
  return motor.low <= position && position <= motor.high;
}

std::string limits_of(const MotorModel& motor) {
  return std::to_string(motor.low) + "..." + std::to_string(motor.high);
}

/// Requires each position to be within its limits: a motor moves a count only if they allow it.
void check_positions(const Model& model, const Motors& motors, std::vector<Detail>& details) {
  for (int i = 0; i < model.motor_count(); ++i) {
    const std::int64_t position = wide_position(model, motors, i);
    const MotorModel& motor = model.motor(i);
    if (is_within(motor, position)) continue;
    details.push_back({child_pointer("/state/motors", at(i)) + "/count", motors[at(i)].count,
                       "a count that puts " + std::string(1, motor.drive.label) +
                           " at a position " + limits_of(motor) + ", not " +
                           std::to_string(position)});
  }
}

void check_others(const Model& model, const Motors& motors, std::vector<Detail>& details) {
  for (int i = model.motor_count(); i < kMaxMotors; ++i) {
    if (motors[at(i)] == MotorState{}) continue;
    details.push_back({child_pointer("/state/motors", at(i)), nullptr,
                       "a motor in its initial state: the robot has only " +
                           std::to_string(model.motor_count()) + " motors"});
  }
}

void check_grasp(const Model& model, const Held& held, std::vector<Detail>& details) {
  for (int i = 0; i < kMaxMotors; ++i) {
    const Counts position = held.grasped_at[at(i)];
    const bool has_motor = i < model.motor_count();
    if (has_motor ? is_within(model.motor(i), position) : position == 0) continue;
    details.push_back(
        {child_pointer("/state/held/grasped_at", at(i)), position,
         has_motor ? "a position " + limits_of(model.motor(i)) : "0: the robot has no such motor"});
  }
}

void check_riders(const Model& model, const std::vector<Rider>& riders,
                  std::vector<Detail>& details) {
  for (std::size_t i = 0; i < riders.size(); ++i) {
    const Counts count = riders[i].count;
    if (model.carousel() && is_within(model.motor(model.carousel_index()), count)) continue;
    details.push_back({child_pointer("/state/riders", i) + "/count", count,
                       model.carousel()
                           ? "a count " + limits_of(model.motor(model.carousel_index()))
                           : "no riders: the robot has no carousel"});
  }
}

void check_fault_joints(const Model& model, const Faults& faults, std::vector<Detail>& details) {
  for (std::size_t i = 0; i < faults.all.size(); ++i) {
    const char joint = faults.all[i].fault.joint;
    if (joint == 0 || model.index_of(joint) >= 0) continue;
    details.push_back({child_pointer("/state/faults/all", i) + "/fault/joint",
                       std::string(1, joint), "a joint of the robot: one of " + model.labels()});
  }
}

// --- Derived values: errors give the required value and the reason.

Json blocked_name(Blocked blocked) {
  if (blocked == Blocked::kNo) return "no";
  return blocked == Blocked::kLimit ? "limit" : "block";
}

std::string why_blocked(const MotorState& derived) {
  if (derived.error == 0) return "it has no counts to go";
  if (derived.blocked == Blocked::kNo) return "nothing blocks its next count";
  if (derived.blocked == Blocked::kLimit) return "its next count would take a joint past a limit";
  return "the jaws touch the block that they hold";
}

void check_motor(const MotorState& found, const MotorState& derived, const std::string& pointer,
                 std::vector<Detail>& details) {
  if (found.switch_closed != derived.switch_closed) {
    details.push_back({pointer + "/switch_closed", found.switch_closed,
                       (derived.switch_closed ? "true: at count " : "false: at count ") +
                           std::to_string(found.count) +
                           (derived.switch_closed ? " it is closed" : " it is open")});
  }
  if (found.blocked != derived.blocked) {
    details.push_back({pointer + "/blocked", blocked_name(found.blocked),
                       blocked_name(derived.blocked).dump() + ": " + why_blocked(derived)});
  }
  if (found.phase != derived.phase) {
    details.push_back({pointer + "/phase", found.phase,
                       derived.error == 0 ? "0: it has no counts to go" : "0: it is blocked"});
  }
}

void check_surface(const Model& model, const State& found, const State& derived,
                   std::vector<Detail>& details) {
  if (found.below_surface == derived.below_surface) return;
  const PointUm tip = tool_tip(model, positions(model, found.motors));
  details.push_back(
      {"/state/below_surface", found.below_surface,
       (derived.below_surface ? "true: the tip is at z " : "false: the tip is at z ") +
           std::to_string(tip.z) + " um, the work surface at " +
           std::to_string(model.workcell().work_surface_um) + " um"});
}

Json point_um(const PointUm& p) { return {p.x, p.y, p.z}; }

/// Requires the pose at the grasp in a held block's entry.
void check_held_block(const Block& found, const Block& derived, const std::string& pointer,
                      std::vector<Detail>& details) {
  if (found.centroid_um != derived.centroid_um) {
    details.push_back(
        {pointer + "/centroid_um", point_um(found.centroid_um),
         point_um(derived.centroid_um).dump() + ": its position when the jaws closed on it"});
  }
  if (found.yaw_udeg != derived.yaw_udeg) {
    details.push_back({pointer + "/yaw_udeg", found.yaw_udeg,
                       std::to_string(derived.yaw_udeg) + ": its yaw when the jaws closed on it"});
  }
}

/// Requires a block on the carousel to be where its count puts it.
void check_turned_block(const Block& found, const Block& derived, const std::string& pointer,
                        std::vector<Detail>& details) {
  if (found == derived) return;
  details.push_back({pointer + "/centroid_um", point_um(found.centroid_um),
                     point_um(derived.centroid_um).dump() + " and yaw " +
                         std::to_string(derived.yaw_udeg) +
                         ": where the carousel has turned it, see riders"});
}

void check_derived(const Model& model, const State& found, std::vector<Detail>& details) {
  const State derived = xr3::derived(model, found);
  for (int i = 0; i < model.motor_count(); ++i) {
    check_motor(found.motor(i), derived.motor(i), child_pointer("/state/motors", at(i)), details);
  }
  check_surface(model, found, derived, details);
  for (const Rider& rider : found.riders) {
    check_turned_block(found.blocks[rider.block], derived.blocks[rider.block],
                       child_pointer("/state/blocks", rider.block), details);
  }
  if (!found.held) return;
  const std::size_t block = found.held->block;
  check_held_block(found.blocks[block], derived.blocks[block],
                   child_pointer("/state/blocks", block), details);
}

// --- The protected region and stalls.

void check_region(const Model& model, const Positions& where, const std::string& pointer,
                  std::vector<Detail>& details) {
  const PointUm tip = tool_tip(model, where);
  if (!is_in_protected_region(model, where, tip)) return;
  details.push_back({pointer, "the tip at " + point_um(tip).dump() + " um",
                     "counts that keep the tip outside the protected region: at least " +
                         std::to_string(model.region_radius_um()) +
                         " um from the base's axis, or at z " +
                         std::to_string(model.region_height_um()) + " um or above"});
}

void check_stall(const Model& model, const State& state, std::vector<Detail>& details) {
  if (could_stall(model, positions(model, state.motors), state.stall)) return;
  const bool by_region = state.stall == Stall::kProtectedRegion;
  details.push_back({"/state/stall", by_region ? "protected_region" : "work_surface",
                     std::string("\"no\": no tick from this state moves the tip ") +
                         (by_region ? "into the protected region" : "downwards")});
}

// --- Held blocks. The tool has not moved since the grasp: closing is blocked, opening releases.

void check_jaws(const Model& model, const State& state, const Held& held,
                std::vector<Detail>& details) {
  const Counts closed = held.grasped_at[at(model.tool_index())];
  const Counts count = state.motor(model.tool_index()).count;
  if (count != closed) {
    details.push_back({child_pointer("/state/motors", at(model.tool_index())) + "/count", count,
                       std::to_string(closed) +
                           ": the count at which the jaws closed on the block that they hold"});
  }
  const Block& block = state.blocks[held.block];
  if (can_hold(model, block, held)) return;
  const Micrometres extent = flat_extent_um(block, held.quarter_turns);
  details.push_back({"/state/held/block", held.block,
                     "a block that fits between the jaws at " + std::to_string(closed) +
                         ", but not one closing count further; between the jaws " +
                         Json(block.name).dump() + " measures " + std::to_string(extent) + " um"});
}

// --- The camera.

void check_camera_rows(const SavedCell& saved, std::vector<Detail>& details) {
  const std::int64_t rows = camera_rows(saved.workcell, saved.state.blocks);
  if (rows <= kMaxCameraRows) return;
  details.push_back({"/state/blocks",
                     "blocks that take " + std::to_string(rows) + " rows of the camera's image",
                     "at most " + std::to_string(kMaxCameraRows) + ", counted for each block"});
}

// --- The tip's path.

void check_path(const State& state, std::vector<Detail>& details) {
  const std::size_t points = state.tip_path.points.size();
  if (state.display.erase == (points == 0)) return;
  details.push_back({"/state/tip_path/points", "a list of " + std::to_string(points),
                     state.display.erase
                         ? "an empty list while display/erase is true"
                         : "at least one position of the tip while display/erase is false"});
}

}  // namespace

std::vector<Detail> validate(const Model& model, const SavedCell& saved) {
  std::vector<Detail> details;
  const State& state = saved.state;
  check_positions(model, state.motors, details);
  check_others(model, state.motors, details);
  if (state.held) check_grasp(model, *state.held, details);
  check_riders(model, state.riders, details);
  check_fault_joints(model, state.faults, details);
  if (!details.empty()) return details;  // the checks below need valid positions
  // The cell may be in another workcell than the saved one.
  const Model there(model.robot(), saved.workcell, model.profile());
  check_path(state, details);
  check_camera_rows(saved, details);
  check_derived(there, state, details);
  check_region(there, positions(there, state.motors), "/state/motors", details);
  check_stall(there, state, details);
  if (!state.held) return details;
  check_jaws(there, state, *state.held, details);
  check_region(there, state.held->grasped_at, "/state/held/grasped_at", details);
  return details;
}

}  // namespace xr3::monitor
