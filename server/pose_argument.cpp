#include "server/pose_argument.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "protocol/text_table.hpp"

namespace xr3 {
namespace {

bool is_angle(const Model& model, int index) {
  const Robot& robot = model.robot();
  if (index == model.tool_index()) return robot.tool.kind == ToolKind::kAngular;
  return robot.joints[static_cast<std::size_t>(index)].variable == JointVariable::kTheta;
}

std::string name(const Model& model, int index) {
  if (index == model.tool_index()) return "the tool";
  return "joint " + std::string(1, model.motor(index).drive.label) + " (" +
         model.robot().joints[static_cast<std::size_t>(index)].name + ")";
}

Counts nearest(const Model& model, int index, double value) {
  const MotorModel& motor = model.motor(index);
  const Drive& drive = motor.drive;
  if (value < drive.min || value > drive.max) {
    throw ArgumentError(name(model, index) + " cannot be at " + plain_number(value) +
                        "; it goes from " + plain_number(drive.min) + " to " +
                        plain_number(drive.max) + (is_angle(model, index) ? " degrees" : " mm"));
  }
  const double counts = (value - drive.home) / drive.precision * drive.direction;
  return std::clamp(static_cast<Counts>(std::lround(counts)), motor.low, motor.high);
}

std::string labels(const Model& model) {
  std::string list;
  for (int k = 0; k < model.joint_count(); ++k) list += " " + name(model, k) + ",";
  list.pop_back();
  return list;
}

}  // namespace

std::vector<double> parse_numbers(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream items(text + ",");
  for (std::string item; std::getline(items, item, ',');) {
    std::istringstream in(item);
    double number = 0;
    if (!(in >> number) || !(in >> std::ws).eof() || !std::isfinite(number)) {
      throw std::invalid_argument(text + ": numbers between commas are wanted, as in 0,-39.5,110");
    }
    numbers.push_back(number);
  }
  return numbers;
}

Positions pose_argument(const Model& model, const std::vector<double>& joints,
                        std::optional<double> tool) {
  Positions positions{};
  if (!joints.empty() && joints.size() != model.robot().joints.size()) {
    throw ArgumentError(std::to_string(joints.size()) + " joint values are given; " +
                        model.robot().name + " has " + std::to_string(model.joint_count()) + ":" +
                        labels(model));
  }
  for (std::size_t k = 0; k < joints.size(); ++k) {
    positions[k] = nearest(model, static_cast<int>(k), joints[k]);
  }
  const int tool_index = model.tool_index();
  if (tool) positions[static_cast<std::size_t>(tool_index)] = nearest(model, tool_index, *tool);
  return positions;
}

}  // namespace xr3
