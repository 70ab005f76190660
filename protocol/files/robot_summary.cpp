#include <limits>
#include <string>
#include <vector>

#include "core/coupling.hpp"
#include "core/kinematics.hpp"
#include "core/switches.hpp"
#include "protocol/files/consistency.hpp"
#include "protocol/files/summary.hpp"
#include "protocol/text/printable.hpp"
#include "protocol/text/table.hpp"

namespace xr3 {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string one_letter(char label) { return std::string(1, label); }

/// `E shoulder`
std::string title_of(const Model& model, int index) {
  return one_letter(model.motor(index).drive.label) + " " + printable_line(model.name(index));
}

std::string unit_of(const Model& model, int index) { return model.is_length(index) ? "mm" : "deg"; }

std::string signed_number(int number) { return (number > 0 ? "+" : "") + std::to_string(number); }

std::string heading(const Robot& robot) {
  const std::string jaws = robot.tool.kind == ToolKind::kParallel ? "parallel" : "angular";
  std::string text = printable_line(robot.name) + ": " + std::to_string(robot.joints.size()) +
                     " joints, " + jaws + " jaws\n";
  if (!robot.notes.empty()) text += robot.notes + "\n";
  return text;
}

std::string mount_text(const Robot& robot) {
  if (!robot.mount) return "";
  const DhRow& row = *robot.mount;
  return "Mount, from the base frame to frame 0: theta " + plain_number(row.theta_deg) +
         " deg, d " + plain_number(row.d_mm) + " mm, a " + plain_number(row.a_mm) + " mm, alpha " +
         plain_number(row.alpha_deg) + " deg\n";
}

std::string dh_table(const Robot& robot) {
  Rows rows = {{"k", "joint", "theta deg", "d mm", "a mm", "alpha deg", "variable"}};
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const Joint& joint = robot.joints[i];
    rows.push_back({std::to_string(i + 1), one_letter(joint.drive.label) + " " + joint.name,
                    plain_number(joint.dh.theta_deg), plain_number(joint.dh.d_mm),
                    plain_number(joint.dh.a_mm), plain_number(joint.dh.alpha_deg),
                    joint.is_revolute() ? "theta" : "d"});
  }
  return "\nDenavit-Hartenberg rows at the soft home\n" + text_table(rows, "rlrrrrl") +
         mount_text(robot);
}

/// The variable's range in whole counts, such as `-139.993 to 9.988 deg`.
std::string reached_range(const Model& model, int index) {
  const MotorModel& motor = model.motor(index);
  const double first = model.variable(index, motor.low);
  const double last = model.variable(index, motor.high);
  return plain_number(std::min(first, last)) + " to " + plain_number(std::max(first, last)) + " " +
         unit_of(model, index);
}

std::string motor_table(const Model& model) {
  Rows rows = {{"motor", "a count is", "from", "to counts", "which is", "counts/s", "direction"}};
  for (int i = 0; i < model.motor_count(); ++i) {
    const MotorModel& motor = model.motor(i);
    rows.push_back(
        {title_of(model, i), plain_number(motor.drive.precision, 5) + " " + unit_of(model, i),
         std::to_string(motor.low), std::to_string(motor.high), reached_range(model, i),
         std::to_string(motor.drive.speed_counts_per_s), signed_number(motor.drive.direction)});
  }
  return "\nMotors: counts are 0 at the soft home\n" + text_table(rows, "llrrlrr");
}

/// The range of counts of its own motor in which a switch is closed.
std::string closed_when(const MotorModel& motor) {
  const CountRange closed = motor.closed;
  using Limits = std::numeric_limits<Counts>;
  if (closed.low == Limits::min()) return std::to_string(closed.high) + " and below";
  if (closed.high == Limits::max()) return std::to_string(closed.low) + " and above";
  const std::string each = motor.period == 0 ? "" : ", every " + std::to_string(motor.period);
  return std::to_string(closed.low) + " to " + std::to_string(closed.high) + each;
}

std::string switch_table(const Model& model) {
  Rows rows = {{"switch", "closed at counts", "bit", "of reply"}};
  for (int i = 0; i < model.motor_count(); ++i) {
    const MotorModel& motor = model.motor(i);
    const int mask = motor.drive.microswitch.mask;
    const std::string reply = is_asked_for(motor.drive.label, 'J') ? "J" : "I";
    rows.push_back({title_of(model, i), closed_when(motor), mask == 0 ? "-" : std::to_string(mask),
                    mask == 0 ? "neither" : reply});
  }
  return "\nMicroswitches\n" + text_table(rows, "llrl");
}

std::string coupling_text(const Model& model) {
  if (model.robot().couplings.empty()) return "Coupling: none\n";
  std::string text;
  for (const Coupling& c : model.robot().couplings) {
    text += "Coupling: motor " + title_of(model, c.joint) + " turns joint " +
            title_of(model, c.coupled) + (c.sign > 0 ? " along with" : " against") + " its own\n";
  }
  return text;
}

std::string region_text(const Model& model) {
  const ProtectedRegion& region = model.robot().protected_region;
  return "Protected region: radius " + plain_number(region.radius_mm) + " mm, height " +
         plain_number(region.height_mm) + " mm, about the base axis" +
         (model.slide_count() > 0 ? ", moving with it\n" : "\n");
}

std::string carousel_text(const Robot& robot) {
  if (!robot.carousel) return "";
  const Carousel& carousel = *robot.carousel;
  return "Carousel: about (" + plain_number(carousel.x_mm) + ", " + plain_number(carousel.y_mm) +
         ") mm, radius " + plain_number(carousel.radius_mm) +
         " mm, top at z = " + plain_number(carousel.height_mm) + " mm\n";
}

std::string net_roll_text(const Model& model) {
  std::string text = "Net roll:";
  for (const RollTerm& term : model.robot().net_roll) {
    text += (term.sign > 0 ? " + " : " - ") + printable_line(model.name(term.joint));
  }
  const double offset = model.robot().net_roll_offset_deg;
  return text + (offset < 0 ? " - " : " + ") + plain_number(std::abs(offset)) + " deg\n";
}

std::string tool_text(const Model& model) {
  const int tool = model.tool_index();
  const double first = opening_mm(model, model.motor(tool).low);
  const double last = opening_mm(model, model.motor(tool).high);
  return "Jaws: open " + plain_number(std::min(first, last)) + " to " +
         plain_number(std::max(first, last)) + " mm, " + plain_number(opening_mm(model, 0)) +
         " mm at the soft home\n";
}

std::string pose_text(const Model& model, const Positions& at) {
  const PointUm tip = tool_tip(model, at);
  const Transform tool = tool_transform(model, at);
  return "tip (" + plain_number(mm(tip.x)) + ", " + plain_number(mm(tip.y)) + ", " +
         plain_number(mm(tip.z)) + ") mm, approach (" + plain_number(tool(0, 2)) + ", " +
         plain_number(tool(1, 2)) + ", " + plain_number(tool(2, 2)) + "), net roll " +
         plain_number(net_roll_deg(model, at)) + " deg\n";
}

std::string homes_text(const Model& model) {
  std::string counts;
  for (int i = 0; i < model.motor_count(); ++i) {
    const MotorModel& motor = model.motor(i);
    if (i > 0) counts += " ";
    counts += one_letter(motor.drive.label) + signed_number(motor.drive.microswitch.position);
  }
  return "Soft home: " + pose_text(model, Positions{}) + "Hard home: " + counts + "\n           " +
         pose_text(model, hard_home(model));
}

}  // namespace

std::string robot_summary(const Robot& robot, Profile profile) {
  const Model model(robot, Workcell{}, profile);
  return heading(robot) + dh_table(robot) + motor_table(model) + switch_table(model) + "\n" +
         coupling_text(model) + region_text(model) + carousel_text(robot) + net_roll_text(model) +
         tool_text(model) + homes_text(model);
}

}  // namespace xr3
