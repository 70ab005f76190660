#include "cli/options/export.hpp"

#include <CLI/CLI.hpp>

#include "cli/options/shared_options.hpp"

namespace xr3 {

void add_export(CLI::App& app, ExportOptions& options) {
  CLI::App& command = *app.add_subcommand(
      "export", "write a robot as files for other programs: ROS, MuJoCo, three.js");
  const auto add_form = [&](const char* name, ExportForm form, const char* what) {
    return command.add_flag_callback(
        name, [&options, form] { options.form = form; }, what);
  };
  CLI::Option* urdf = add_form("--urdf", ExportForm::kUrdf, "NAME.urdf, and meshes");
  CLI::Option* mjcf = add_form("--mjcf", ExportForm::kMjcf, "NAME.xml for MuJoCo, and meshes");
  urdf->excludes(mjcf);
  command.callback([urdf, mjcf] {
    if (urdf->count() + mjcf->count() == 0)
      throw CLI::ValidationError("xr3 export needs --urdf or --mjcf");
  });
  add_value(command, "robot", options.robot, "NAME|FILE", "the robot: a name, or a file")
      ->required();
  add_value(command, "folder", options.folder, "FOLDER",
            "the folder of the files (default: one with the robot's name, in this folder)");
  command.add_flag("--force", options.force, "replace the robot's file if it is there already");
}

}  // namespace xr3
