#include "protocol/files/motor_consistency.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/switches.hpp"
#include "protocol/text/table.hpp"

namespace xr3 {
namespace {

using data::Reading;

constexpr const char* kToolPointer = "/tool";
constexpr int kHighestBitOfJ = 2;  // bits 2 to 5 of J are input lines

constexpr char kToolLabel = 'A';

/// Requires A for the tool, and for each joint another letter than A that no other joint has.
void check_label(const CheckedMotor& motor, Reading& reading, std::set<char>& taken) {
  const std::string pointer = motor.pointer + "/label";
  if (!reading.is_sound(pointer)) return;
  const char label = motor.drive->label;
  const std::string found = "\"" + std::string(1, label) + "\"";
  const bool is_tool = motor.pointer == kToolPointer;
  if (is_tool != (label == kToolLabel)) {
    return reading.refuse(
        pointer, found,
        is_tool ? "\"A\": the tool is always A" : "a letter \"B\" to \"H\": A is the tool");
  }
  if (taken.insert(label).second) return;
  reading.refuse(pointer, found + ", a duplicate", "a letter \"B\" to \"H\" that nothing else has");
}

/// Requires limits in order, the home within them, and a range that does not exceed
/// kMaxCountsFromHome.
void check_limits(const CheckedMotor& motor, Reading& reading) {
  const std::string pointer = motor.pointer + "/limits";
  if (!reading.is_sound(pointer)) return;
  const Drive& drive = *motor.drive;
  const double unit = motor.is_length ? reading.mm_per_unit() : 1;
  const std::string found =
      "[" + number_text(drive.min / unit) + ", " + number_text(drive.max / unit) + "]";
  if (drive.min >= drive.max) return reading.refuse(pointer, found, "the lower limit first");
  if (motor.is_length && std::max(-drive.min, drive.max) > data::kMaxLengthMm) {
    return reading.refuse(pointer, found,
                          "lengths of up to " + number_text(data::kMaxLengthMm) + " mm");
  }
  const std::string home = motor.pointer + motor.home_member;
  if (!reading.is_sound(home) || !reading.is_sound(motor.pointer + "/variable")) return;
  if (drive.home < drive.min || drive.home > drive.max) {
    return reading.refuse(home, number_text(drive.home / unit),
                          "a home within the limits " + found);
  }
  if (!reading.is_sound(motor.pointer + "/precision")) return;
  const double range = std::max(drive.max - drive.home, drive.home - drive.min) / drive.precision;
  if (range > kMaxCountsFromHome) {
    reading.refuse(pointer, number_text(std::floor(range)) + " counts from the home to a limit",
                   "up to " + number_text(kMaxCountsFromHome) + " counts");
  }
}

/// Requires a bit that no other switch of the same reply has. J has only two bits for switches; the
/// others are input lines.
void check_mask(const CheckedMotor& motor, Reading& reading, std::set<int>& taken_i,
                std::set<int>& taken_j) {
  const std::string pointer = motor.pointer + "/switch/mask";
  const int mask = motor.drive->microswitch.mask;
  if (!reading.is_sound(pointer) || !reading.is_sound(motor.pointer + "/label") || mask == 0)
    return;
  const bool in_j = is_asked_for(motor.drive->label, 'J');
  const std::string reply = in_j ? "J" : "I";
  if (in_j && mask > kHighestBitOfJ) {
    return reading.refuse(pointer, std::to_string(mask),
                          "1 or 2, or 0 for none: J has room for two switches");
  }
  if (!(in_j ? taken_j : taken_i).insert(mask).second) {
    reading.refuse(pointer, std::to_string(mask) + ", a duplicate",
                   "a bit of the reply to " + reply + " that no other switch has");
  }
}

void check_switch_position(const CheckedMotor& motor, Reading& reading) {
  const std::string pointer = motor.pointer + "/switch/position";
  const Microswitch& microswitch = motor.drive->microswitch;
  if (!reading.is_sound(pointer) || microswitch.position != 0 || microswitch.width) return;
  reading.refuse(pointer, "0", "a count other than 0, or a width beside it");
}

}  // namespace

std::vector<CheckedMotor> motors_of(const Robot& robot) {
  std::vector<CheckedMotor> motors;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const Joint& joint = robot.joints[i];
    const bool turns = joint.is_revolute();
    motors.push_back(
        {&joint.drive, "/joints/" + std::to_string(i), turns ? "/theta_deg" : "/d", !turns});
  }
  const bool hinges = robot.tool.kind == ToolKind::kAngular;
  motors.push_back({&robot.tool.drive, kToolPointer, "/home", !hinges});
  if (robot.carousel) motors.push_back({&robot.carousel->drive, "/carousel", "/limits", false});
  return motors;
}

void check_motors(const Robot& robot, Reading& reading) {
  std::set<char> labels;
  std::set<int> taken_i;
  std::set<int> taken_j;
  for (const CheckedMotor& motor : motors_of(robot)) {
    check_label(motor, reading, labels);
    check_limits(motor, reading);
    check_mask(motor, reading, taken_i, taken_j);
    check_switch_position(motor, reading);
  }
}

}  // namespace xr3
