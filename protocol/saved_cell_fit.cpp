// Whether a saved cell fits a robot: see misfits() in saved_cell_json.hpp.
#include <string>
#include <utility>

#include "protocol/saved_cell_json.hpp"

namespace xr3::monitor {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// The position of a joint or the tool; wide, since these counts may be anybody's.
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

/// Every count of a machine is checked against the limits before it is made.
void check_positions(const Model& model, const Motors& motors, std::vector<Detail>& details) {
  for (int i = 0; i < model.motor_count(); ++i) {
    const std::int64_t position = wide_position(model, motors, i);
    const MotorModel& motor = model.motor(i);
    if (is_within(motor, position)) continue;
    details.push_back({child_pointer("/state/motors", at(i)) + "/count", motors[at(i)].count,
                       "a count with which " + std::string(1, motor.drive.label) +
                           " stands at a position " + limits_of(motor) + ", not " +
                           std::to_string(position)});
  }
}

void check_others(const Model& model, const Motors& motors, std::vector<Detail>& details) {
  for (int i = model.motor_count(); i < kMaxMotors; ++i) {
    if (motors[at(i)] == MotorState{}) continue;
    details.push_back(
        {child_pointer("/state/motors", at(i)), nullptr,
         "a motor that never moved: the robot has " + std::to_string(model.motor_count())});
  }
}

void check_grasp(const Model& model, const Held& held, std::vector<Detail>& details) {
  for (int i = 0; i < kMaxMotors; ++i) {
    const Counts position = held.grasped_at[at(i)];
    const bool has_motor = i < model.motor_count();
    if (has_motor ? is_within(model.motor(i), position) : position == 0) continue;
    details.push_back({child_pointer("/state/held/grasped_at", at(i)), position,
                       has_motor ? "a position " + limits_of(model.motor(i)) : "0: no such motor"});
  }
}

}  // namespace

std::vector<Detail> misfits(const Model& model, const SavedCell& saved) {
  std::vector<Detail> details;
  check_positions(model, saved.state.motors, details);
  check_others(model, saved.state.motors, details);
  if (saved.state.held) check_grasp(model, *saved.state.held, details);
  return details;
}

}  // namespace xr3::monitor
