#include "protocol/monitor/overview.hpp"

#include <nlohmann/json.hpp>

#include "core/motor.hpp"
#include "core/step.hpp"
#include "protocol/json/values.hpp"
#include "protocol/monitor/snapshot.hpp"

namespace xr3::monitor {
namespace {

constexpr int kDecimals = 1;

template <class Value>
Json json_or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

Json command_json(const std::optional<CommandSummary>& command) {
  if (!command) return {};
  return {{"text", command->text}, {"count", command->count}, {"has_reply", command->has_reply}};
}

Json warning_json(const std::optional<WarningSummary>& warning) {
  if (!warning) return {};
  return {{"text", warning->text}, {"at", warning->at}, {"count", warning->count}};
}

Json points_json(const std::optional<PointsSummary>& points) {
  return points ? Json{points->met, points->most} : Json();
}

}  // namespace

CellSummary machine_summary(const Model& model, const State& state) {
  CellSummary cell;
  cell.robot = model.robot().name;
  cell.is_moving = !is_at_rest(model, state);
  cell.stall = state.stall;
  if (state.held) cell.holding = state.blocks[state.held->block].name;
  cell.tick = state.tick;
  const Positions at = positions(model, state.motors);
  const auto variable = [&](int index) {
    return rounded(model.variable(index, at[static_cast<std::size_t>(index)]), kDecimals);
  };
  for (int k = 0; k < model.joint_count(); ++k) cell.joints.push_back(variable(k));
  if (model.carousel()) cell.joints.push_back(variable(model.carousel_index()));
  cell.tool = variable(model.tool_index());
  return cell;
}

Json summary_json(const CellSummary& cell) {
  return {{"name", cell.name},
          {"robot", cell.robot},
          {"robot_port", json_or_null(cell.robot_port)},
          {"lines", cell.lines},
          {"peer", json_or_null(cell.peer)},
          {"owner", json_or_null(cell.owner)},
          {"moving", cell.is_moving},
          {"stalled", stall_json(cell.stall)},
          {"holding", json_or_null(cell.holding)},
          {"recording_failed", cell.has_recording_failed},
          {"last_input_tick", json_or_null(cell.last_input_tick)},
          {"epoch", cell.epoch},
          {"tick", cell.tick},
          {"joints", cell.joints},
          {"tool", cell.tool},
          {"paused", cell.is_paused},
          {"frozen", cell.is_frozen},
          {"coming_back", cell.is_coming_back},
          {"viewers", cell.viewers},
          {"last_input_at", json_or_null(cell.last_input_at)},
          {"last_command", command_json(cell.last_command)},
          {"stalled_at", json_or_null(cell.stalled_at)},
          {"last_warning", warning_json(cell.last_warning)},
          {"goals", json_or_null(cell.goals)},
          {"points", points_json(cell.points)}};
}

bool is_news(const CellSummary& before, const CellSummary& now) {
  const auto shown = [](const CellSummary& cell) {
    return std::tie(cell.name, cell.robot, cell.robot_port, cell.lines, cell.peer, cell.owner,
                    cell.is_moving, cell.stall, cell.holding, cell.has_recording_failed,
                    cell.last_input_tick, cell.epoch, cell.joints, cell.tool, cell.is_paused,
                    cell.is_frozen, cell.is_coming_back, cell.viewers, cell.last_input_at,
                    cell.last_command, cell.stalled_at, cell.last_warning, cell.goals, cell.points);
  };
  return shown(before) != shown(now);
}

Message overview_message(std::int64_t seq, UnixMs now, bool is_whole,
                         const std::vector<std::string>& cells,
                         const std::vector<std::string>& closed) {
  std::string text = R"({"op":"overview","seq":)" + std::to_string(seq);
  text.append(R"(,"now":)").append(std::to_string(now));
  text.append(R"(,"whole":)").append(is_whole ? "true" : "false").append(R"(,"cells":[)");
  for (std::size_t i = 0; i < cells.size(); ++i) text.append(i > 0 ? "," : "").append(cells[i]);
  text.append(R"(],"closed":)").append(text_of(Json(closed))).append("}");
  return std::make_shared<const std::string>(std::move(text));
}

}  // namespace xr3::monitor
