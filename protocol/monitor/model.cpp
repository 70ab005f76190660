#include "protocol/monitor/model.hpp"

#include <nlohmann/json.hpp>

#include "core/coupling.hpp"
#include "core/drawing/stick_figure.hpp"
#include "core/grasp.hpp"
#include "protocol/files/robot.hpp"
#include "protocol/files/workcell.hpp"

namespace xr3 {

Workcell workcell_now(const Model& model, const State& state) {
  Workcell workcell = model.workcell();
  workcell.blocks = state.blocks;
  if (state.held) {
    workcell.blocks.edit()[state.held->block] =
        as_released(model, state, *state.held, positions(model, state.motors));
  }
  return workcell;
}

Json model_json(const Model& model, const State& state, int rev, std::string_view hash) {
  Json::object_t members;
  members.reserve(4);  // an object that grows copies its members
  members["rev"] = rev;
  const std::optional<Robot> figure = stick_figure(model.robot());
  members["robot"] = robot_to_json(figure ? *figure : model.robot());
  members["workcell"] = workcell_to_json(workcell_now(model, state));
  members["hash"] = hash;
  return members;
}

}  // namespace xr3
