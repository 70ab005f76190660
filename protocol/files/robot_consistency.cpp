// The rules of robot files; declared in consistency.hpp.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/coupling.hpp"
#include "core/kinematics.hpp"
#include "core/model.hpp"
#include "core/stall.hpp"
#include "core/switches.hpp"
#include "protocol/files/consistency.hpp"
#include "protocol/text/table.hpp"

namespace xr3 {
namespace {

using data::Reading;

/// Maximum distance of the limits from the soft home, in counts, so that sums of counts never
/// overflow.
constexpr double kMaxCountsFromHome = 1e8;

constexpr const char* kToolPointer = "/tool";
constexpr char kToolLabel = 'A';

std::string number_text(double number) { return plain_number(number, 4); }

// --- The rules for motors, of joints, tool and carousel alike.

/// The drive of a joint, of the tool or of the carousel, with the data that the common rules need.
struct CheckedMotor {
  const Drive* drive;
  std::string pointer;      ///< pointer of the joint, the tool or the carousel
  std::string home_member;  ///< `/theta_deg`, `/d`, `/home`, or `/limits` if there is no home
  bool is_length;           ///< the variable is a length, not an angle
};

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

/// Requires a bit that no other switch of the same reply has.
void check_mask(const CheckedMotor& motor, Reading& reading, std::set<int>& taken_i,
                std::set<int>& taken_j) {
  const std::string pointer = motor.pointer + "/switch/mask";
  const int mask = motor.drive->microswitch.mask;
  if (!reading.is_sound(pointer) || !reading.is_sound(motor.pointer + "/label") || mask == 0)
    return;
  const bool in_j = is_asked_for(motor.drive->label, 'J');
  const std::string reply = in_j ? "J" : "I";
  if (!(in_j ? taken_j : taken_i).insert(mask).second) {
    reading.refuse(pointer, std::to_string(mask) + ", a duplicate",
                   "a bit of the reply to " + reply + " that no other switch has");
  }
}

/// Requires that the switch is open during at least half of each period.
void check_period(const CheckedMotor& motor, Reading& reading) {
  const std::string pointer = motor.pointer + "/switch/period";
  const Microswitch& microswitch = motor.drive->microswitch;
  if (!microswitch.period || !reading.is_sound(pointer)) return;
  const Counts least = 2 * microswitch.width.value_or(kMark3SwitchRange);
  if (*microswitch.period >= least) return;
  reading.refuse(pointer, std::to_string(*microswitch.period),
                 std::to_string(least) + " or more: twice the counts in which it is closed");
}

void check_switch_position(const CheckedMotor& motor, Reading& reading) {
  const std::string pointer = motor.pointer + "/switch/position";
  const Microswitch& microswitch = motor.drive->microswitch;
  if (!reading.is_sound(pointer) || microswitch.position != 0 || microswitch.width) return;
  reading.refuse(pointer, "0", "a count other than 0, or a width beside it");
}

/// The joints from the base, then the tool, then the carousel. The elements point into `robot`.
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
    check_period(motor, reading);
  }
}

// --- The other rules.

void check_joint_names(const Robot& robot, Reading& reading) {
  data::check_names(robot.joints, "/joints", "joint", reading);
  if (!robot.carousel || !reading.is_sound("/carousel/name")) return;
  const std::string& name = robot.carousel->name;
  const bool is_new = std::none_of(robot.joints.begin(), robot.joints.end(),
                                   [&](const Joint& joint) { return joint.name == name; });
  if (is_new) return;
  reading.refuse("/carousel/name", "\"" + name + "\", a duplicate", "a name that no joint has");
}

std::string pivot_pointer(std::size_t part) {
  return "/tool/parts/" + std::to_string(part) + "/pivot";
}

void check_parallel(const Tool& tool, Reading& reading) {
  if (reading.is_sound("/tool/limits") && tool.drive.min < 0) {
    reading.refuse("/tool/limits", number_text(tool.drive.min), "an opening of 0 or more");
  }
  if (tool.finger_length_mm != 0) {
    reading.refuse("/tool/finger_length", number_text(tool.finger_length_mm),
                   "nothing: only angular jaws have it");
  }
  for (std::size_t i = 0; i < tool.parts.size(); ++i) {
    if (tool.parts[i].pivot_mm == PointMm{}) continue;
    reading.refuse(pivot_pointer(i), "a pivot", "nothing: only angular jaws have it");
  }
}

void check_angular(const Tool& tool, Reading& reading) {
  if (reading.is_sound("/tool/limits") && (tool.drive.min < 0 || tool.drive.max > 180)) {
    reading.refuse("/tool/limits",
                   "[" + number_text(tool.drive.min) + ", " + number_text(tool.drive.max) + "]",
                   "an angle between the fingers from 0 to 180 degrees");
  }
  if (reading.is_sound("/tool/finger_length") && tool.finger_length_mm <= 0) {
    reading.refuse("/tool/finger_length", "", "a length above 0 mm: angular jaws need it");
  }
  for (std::size_t i = 0; i < tool.parts.size(); ++i) {
    if (!reading.is_sound(pivot_pointer(i)) || tool.parts[i].pivot_mm != PointMm{}) continue;
    reading.refuse(pivot_pointer(i), "", "a list [x, y, z], the hinge: angular jaws need it");
  }
}

void check_tool(const Robot& robot, Reading& reading) {
  if (!reading.is_sound("/tool/kind")) return;
  const bool slides = robot.tool.kind == ToolKind::kParallel;
  slides ? check_parallel(robot.tool, reading) : check_angular(robot.tool, reading);
}

void check_pen(const std::vector<OutlinePoint>& points, const std::string& pointer,
               Reading& reading) {
  if (points.empty() || !points.front().draw || !reading.is_sound(pointer)) return;
  reading.refuse(pointer + "/0", "\"draw\"", "\"move\" at the first point");
}

/// Requires one outline per frame, or none, and that each begins with a move.
void check_outlines(const Robot& robot, Reading& reading) {
  const std::size_t frames = robot.joints.size() + 1;
  if (!robot.joints.empty() && !robot.links.empty() && robot.links.size() != frames) {
    reading.refuse(
        "/links", "a list of " + std::to_string(robot.links.size()),
        "a list of " + std::to_string(frames) + ", the base's first and the tool's last, or none");
  }
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    check_pen(robot.links[i].points, "/links/" + std::to_string(i) + "/points", reading);
  }
  for (std::size_t i = 0; i < robot.tool.parts.size(); ++i) {
    check_pen(robot.tool.parts[i].points, "/tool/parts/" + std::to_string(i) + "/points", reading);
  }
}

/// Whether couplings lead from `joint` to `target` in at most `steps` steps.
bool leads_to(const std::vector<Coupling>& couplings, int joint, int target, std::size_t steps) {
  if (joint == target) return true;
  if (steps == 0) return false;
  for (const Coupling& c : couplings) {
    if (c.joint == joint && leads_to(couplings, c.coupled, target, steps - 1)) return true;
  }
  return false;
}

void check_coupling(const Robot& robot, std::size_t index, Reading& reading) {
  const std::string pointer = "/coupling/" + std::to_string(index);
  if (!reading.is_sound(pointer)) return;
  const Coupling& c = robot.couplings[index];
  const int n = static_cast<int>(robot.joints.size());
  const std::string found =
      "joint " + std::to_string(c.joint + 1) + " coupled to joint " + std::to_string(c.coupled + 1);
  if (c.joint >= n || c.coupled >= n) {
    return reading.refuse(pointer, found, "joints 1 to " + std::to_string(n));
  }
  if (c.joint == c.coupled) return reading.refuse(pointer, found, "two different joints");
  const std::vector<Coupling> before(robot.couplings.begin(),
                                     robot.couplings.begin() + static_cast<std::ptrdiff_t>(index));
  for (const Coupling& other : before) {
    if (other.joint == c.joint && other.coupled == c.coupled) {
      return reading.refuse(pointer, found + ", a duplicate", "each pair of joints once");
    }
  }
  if (leads_to(before, c.coupled, c.joint, static_cast<std::size_t>(n))) {
    reading.refuse(pointer, found + ", which leads back to it", "couplings without a cycle");
  }
}

void check_couplings(const Robot& robot, Reading& reading) {
  if (robot.joints.empty()) return;
  for (std::size_t i = 0; i < robot.couplings.size(); ++i) check_coupling(robot, i, reading);
}

void check_net_roll(const Robot& robot, Reading& reading) {
  if (robot.joints.empty()) return;
  std::set<int> named;
  for (std::size_t i = 0; i < robot.net_roll.size(); ++i) {
    const std::string pointer = "/net_roll/" + std::to_string(i);
    if (!reading.is_sound(pointer)) continue;
    const int joint = robot.net_roll[i].joint;
    const std::string found = "joint " + std::to_string(joint + 1);
    if (joint >= static_cast<int>(robot.joints.size())) {
      reading.refuse(pointer, found, "joints 1 to " + std::to_string(robot.joints.size()));
    } else if (!robot.joints[static_cast<std::size_t>(joint)].is_revolute()) {
      reading.refuse(pointer, found + ", which does not turn", "joints whose variable is theta");
    } else if (!named.insert(joint).second) {
      reading.refuse(pointer, found + ", a duplicate", "each joint once");
    }
  }
}

std::string tip_text(const PointUm& p) {
  return "(" + number_text(mm(p.x)) + ", " + number_text(mm(p.y)) + ", " + number_text(mm(p.z)) +
         ") mm";
}

void check_tip(const Model& model, const Positions& at, const std::string& home, Reading& reading) {
  const PointUm tip = tool_tip(model, at);
  if (!is_in_protected_region(model, at, tip)) return;
  reading.refuse("/protected_region",
                 "the tool tip at the " + home + " home, " + tip_text(tip) + ", inside it",
                 "a region that leaves both homes out");
}

/// Requires the hard home to be within the limits and outside the protected region.
void check_hard_home(const Model& model, Reading& reading) {
  const Positions at = hard_home(model);
  const std::string coupled = model.robot().couplings.empty() ? "" : ", coupling included";
  bool is_within_limits = true;
  for (const CheckedMotor& motor : motors_of(model.robot())) {
    const int index = model.index_of(motor.drive->label);
    const MotorModel& limits = model.motor(index);
    const Counts position = at[static_cast<std::size_t>(index)];
    if (position >= limits.low && position <= limits.high) continue;
    is_within_limits = false;
    reading.refuse(motor.pointer + "/switch/position",
                   "a switch at position " + std::to_string(position) + coupled,
                   std::to_string(limits.low) + " to " + std::to_string(limits.high) +
                       ", the limits in counts");
  }
  if (is_within_limits) check_tip(model, at, "hard", reading);
}

}  // namespace

Positions hard_home(const Model& model) {
  Positions result{};
  for (int i = 0; i < model.motor_count(); ++i) {
    turn(model, result, i, model.motor(i).drive.microswitch.position);
  }
  return result;
}

void check_robot(const Robot& robot, Reading& reading) {
  check_motors(robot, reading);
  check_joint_names(robot, reading);
  check_tool(robot, reading);
  check_outlines(robot, reading);
  check_couplings(robot, reading);
  check_net_roll(robot, reading);
  if (reading.has_errors()) return;
  const Model model(robot, Workcell{}, Profile::kPaper);
  check_tip(model, Positions{}, "soft", reading);
  check_hard_home(model, reading);
}

}  // namespace xr3
