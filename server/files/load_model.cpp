#include "server/files/load_model.hpp"

#include <filesystem>
#include <memory>

#include "protocol/files/paper_form/paper_form.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

std::string workcell_name(const ModelFiles& files) {
  if (!files.workcell.empty()) return files.workcell;
  std::string name = std::filesystem::path(files.robot).stem();
  if (has_data_file(name, "workcells")) return name;
  throw FileError("there is no workcell named after the robot " + name +
                  "; name one with --workcell");
}

}  // namespace

ModelPtr load_model(const ModelFiles& files) {
  const DataFile robot_file = with_option_source(
      files.option_sources, "--robot", [&] { return find_data_file(files.robot, "robots"); });
  const Robot robot = load_robot_of_either_form(robot_file.text, robot_file.path);
  const DataFile workcell_file = with_option_source(files.option_sources, "--workcell", [&] {
    return find_data_file(workcell_name(files), "workcells");
  });
  const Workcell workcell = load_workcell_of_either_form(workcell_file.text, workcell_file.path);
  return std::make_shared<const Model>(robot, workcell, files.profile);
}

std::optional<Robot> robot_with_name_of(const std::string& workcell_file) {
  const std::string name = std::filesystem::path(workcell_file).stem();
  if (!has_data_file(name, "robots")) return std::nullopt;
  const DataFile data = find_data_file(name, "robots");
  return load_robot_of_either_form(data.text, data.path);
}

}  // namespace xr3
