#include "server/files/load_model.hpp"

#include <filesystem>
#include <memory>

#include "core/inverse/empty_table.hpp"
#include "protocol/files/paper_form/paper_form.hpp"
#include "protocol/goals/file.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

std::string workcell_name(const ModelFiles& files) {
  if (!files.workcell.empty()) return files.workcell;
  const std::string name = std::filesystem::path(files.robot).stem();
  return has_data_file(name, "workcells") ? name : kNoWorkcell;
}

Workcell workcell_for(const Robot& robot, const std::string& name) {
  if (name == kNoWorkcell) return empty_table(Reach(robot));
  const DataFile file = find_data_file(name, "workcells");
  return load_workcell_of_either_form(file.text, file.path);
}

}  // namespace

ModelPtr load_model(const ModelFiles& files) {
  const DataFile robot_file = with_option_source(
      files.option_sources, "--robot", [&] { return find_data_file(files.robot, "robots"); });
  const Robot robot = load_robot_of_either_form(robot_file.text, robot_file.path);
  const Workcell workcell = with_option_source(files.option_sources, "--workcell", [&] {
    return workcell_for(robot, workcell_name(files));
  });
  return std::make_shared<const Model>(robot, workcell, files.profile);
}

std::optional<Robot> robot_with_name_of(const std::string& workcell_file) {
  const std::string name = std::filesystem::path(workcell_file).stem();
  if (!has_data_file(name, "robots")) return std::nullopt;
  const DataFile data = find_data_file(name, "robots");
  return load_robot_of_either_form(data.text, data.path);
}

GoalList load_goal_list(const std::string& file, const Model& model) {
  const DataFile data = find_data_file(file, "goals");
  return load_goals(data.text, data.path, model);
}

}  // namespace xr3
