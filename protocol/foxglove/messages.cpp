#include "protocol/foxglove/messages.hpp"

#include <nlohmann/json.hpp>
#include <variant>

#include "core/kinematics.hpp"
#include "core/step.hpp"
#include "protocol/explain/event_report.hpp"
#include "protocol/foxglove/geometry.hpp"
#include "protocol/json/values.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/snapshot.hpp"

namespace xr3::foxglove {
namespace {

using monitor::text_of;

/// foxglove.LogLevel.
enum class LogLevel : std::uint8_t { kInfo = 2, kWarning = 3, kError = 4 };

LogLevel level_of(std::string_view event) {
  if (event == "stalled") return LogLevel::kError;
  return event == "warning" || event == "fault" ? LogLevel::kWarning : LogLevel::kInfo;
}

Json transform_json(const SceneLink& link, const std::string& parent, const Transform& pose,
                    const Json& time) {
  return Json::object({{"timestamp", time},
                       {"parent_frame_id", parent},
                       {"child_frame_id", link.name},
                       {"translation", metres_json(pose.block<3, 1>(0, 3))},
                       {"rotation", quaternion_json(pose)}});
}

/// The variable of a link's motor; 0 if the link is fixed.
double variable_of(const SceneLink& link, const Model& model, const Positions& at) {
  return link.motor < 0 ? 0 : model.variable(link.motor, at[static_cast<std::size_t>(link.motor)]);
}

Json motor_json(const Model& model, const State& state, const Positions& at, int index) {
  const MotorState& motor = state.motor(index);
  const double value = model.variable(index, at[static_cast<std::size_t>(index)]);
  const int decimals = model.is_length(index) ? kMmDecimals : kDegreeDecimals;
  return Json::object({{"value", rounded(value, decimals)},
                       {"count", motor.count},
                       {"error", motor.error},
                       {"moving", state.stall == Stall::kNo && is_running(motor)}});
}

Json motors_json(const Model& model, const State& state, const Positions& at) {
  Json motors = Json::object();
  for (int index = 0; index < model.motor_count(); ++index) {
    const std::string label(1, model.motor(index).drive.label);
    motors[label] = motor_json(model, state, at, index);
  }
  return motors;
}

Json tip_json(const PointUm& tip) {
  const auto length = [](Micrometres um) { return rounded(mm(um), kMmDecimals); };
  return Json::object({{"x_mm", length(tip.x)}, {"y_mm", length(tip.y)}, {"z_mm", length(tip.z)}});
}

std::string text_or_empty(const Json& text) {
  return text.is_string() ? text.get<std::string>() : std::string();
}

}  // namespace

std::string transforms_text(const std::vector<SceneLink>& links, const Model& model,
                            const State& state, Nanoseconds time) {
  const Json stamp = time_json(time);
  const Positions at = positions(model, state.motors);
  Json transforms = Json::array();
  for (const SceneLink& link : links) {
    if (link.parent < 0) continue;
    const Transform pose = relative_pose(link, variable_of(link, model, at));
    const SceneLink& parent = links[static_cast<std::size_t>(link.parent)];
    transforms.push_back(transform_json(link, parent.name, pose, stamp));
  }
  return text_of(Json::object({{"transforms", std::move(transforms)}}));
}

std::string image_text(std::string_view png, Nanoseconds time) {
  return text_of(Json::object(
      {{"timestamp", time_json(time)}, {"frame_id", "base"}, {"data", png}, {"format", "png"}}));
}

std::string log_text(const CellEvent& event, const Model& model, Nanoseconds time) {
  const EventReport about = report(event, model);
  const std::string kind(about.event);
  const bool is_told = about.code.empty() || about.code == about.event;
  return text_of(Json::object({{"timestamp", time_json(time)},
                               {"level", level_of(kind)},
                               {"message", about.message},
                               {"name", is_told ? kind : kind + "/" + std::string(about.code)},
                               {"file", ""},
                               {"line", 0}}));
}

std::string state_text(const Model& model, const State& state, Epoch epoch) {
  const Positions at = positions(model, state.motors);
  const Counts tool = at[static_cast<std::size_t>(model.tool_index())];
  return text_of(
      Json::object({{"tick", state.tick},
                    {"epoch", epoch},
                    {"moving", !is_at_rest(model, state)},
                    {"stalled", text_or_empty(stall_json(state.stall))},
                    {"enabled", state.enabled},
                    {"joints", motors_json(model, state, at)},
                    {"tip", tip_json(tool_tip(model, at))},
                    {"opening_mm", rounded(opening_mm(model, tool), kMmDecimals)},
                    {"holding", state.held ? state.blocks[state.held->block].name : std::string()},
                    {"inputs", state.io.inputs},
                    {"outputs", state.io.outputs}}));
}

}  // namespace xr3::foxglove
