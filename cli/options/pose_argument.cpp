#include "cli/options/pose_argument.hpp"

#include <algorithm>
#include <cmath>

#include "core/inverse/chain.hpp"
#include "protocol/text/table.hpp"

namespace xr3 {
namespace {

std::string name(const Model& model, int index) {
  if (index == model.tool_index()) return "the tool";
  return "joint " + std::string(1, model.motor(index).drive.label) + " (" + model.name(index) + ")";
}

void check_limits(const Model& model, int index, double value) {
  const Drive& drive = model.motor(index).drive;
  if (value >= drive.min && value <= drive.max) return;
  throw ArgumentError(name(model, index) + " cannot be at " + plain_number(value) +
                      "; it goes from " + plain_number(drive.min) + " to " +
                      plain_number(drive.max) + (model.is_length(index) ? " mm" : " degrees"));
}

Counts tool_counts(const Model& model, double value) {
  const MotorModel& tool = model.motor(model.tool_index());
  const double counts = (value - tool.drive.home) / tool.drive.precision * tool.drive.direction;
  return std::clamp(static_cast<Counts>(std::lround(counts)), tool.low, tool.high);
}

std::string labels(const Model& model) {
  std::string list;
  for (int k = 0; k < model.joint_count(); ++k) list += " " + name(model, k) + ",";
  list.pop_back();
  return list;
}

}  // namespace

Positions pose_argument(const Model& model, const std::vector<double>& joints,
                        std::optional<double> tool) {
  Positions positions{};
  if (!joints.empty() && joints.size() != model.robot().joints.size()) {
    throw ArgumentError(std::to_string(joints.size()) + " joint values are given; " +
                        model.robot().name + " has " + std::to_string(model.joint_count()) + ":" +
                        labels(model));
  }
  for (int k = 0; k < static_cast<int>(joints.size()); ++k) {
    check_limits(model, k, joints[static_cast<std::size_t>(k)]);
  }
  if (!joints.empty()) positions = nearest_counts(model, joints).positions;
  for (int k = 0; k < model.joint_count(); ++k) {
    Counts& position = positions[static_cast<std::size_t>(k)];
    position = std::clamp(position, model.motor(k).low, model.motor(k).high);
  }
  if (tool) {
    check_limits(model, model.tool_index(), *tool);
    positions[static_cast<std::size_t>(model.tool_index())] = tool_counts(model, *tool);
  }
  return positions;
}

}  // namespace xr3
