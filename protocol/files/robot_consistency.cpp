#include "protocol/files/robot_consistency.hpp"

#include <set>
#include <string>
#include <vector>

#include "core/coupling.hpp"
#include "core/kinematics.hpp"
#include "core/model.hpp"
#include "core/stall.hpp"
#include "protocol/files/motor_consistency.hpp"
#include "protocol/text/table.hpp"

namespace xr3 {
namespace {

using data::Reading;

std::string joint_pointer(std::size_t index) { return "/joints/" + std::to_string(index); }

void check_joint_names(const Robot& robot, Reading& reading) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const std::string pointer = joint_pointer(i) + "/name";
    if (!reading.is_sound(pointer) || names.insert(robot.joints[i].name).second) continue;
    reading.refuse(pointer, "\"" + robot.joints[i].name + "\", a duplicate",
                   "a name that no other joint has");
  }
  if (!robot.carousel || !reading.is_sound("/carousel/name")) return;
  if (!names.insert(robot.carousel->name).second) {
    reading.refuse("/carousel/name", "\"" + robot.carousel->name + "\", a duplicate",
                   "a name that no joint has");
  }
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
