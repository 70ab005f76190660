#include <filesystem>

#include "cli/commands/commands.hpp"
#include "cli/commands/fail.hpp"
#include "protocol/files/paper_form/paper_form.hpp"
#include "protocol/text/printable.hpp"
#include "server/files/atomic_write.hpp"
#include "server/files/data_files.hpp"
#include "server/print.hpp"
#include "tools/export/exported.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

std::vector<ExportedFile> exported(const ExportOptions& options, const std::string& name) {
  const DataFile file = find_data_file(options.robot, "robots");
  const Model model(load_robot_of_either_form(file.text, file.path), Workcell{}, Profile::kPaper);
  return options.form == ExportForm::kUrdf ? to_urdf(model, name) : to_mjcf(model, name);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw FileError(folder.string() + ": " + error.message());
}

/// Writes the robot's file last: a file that exists has its meshes.
void write_files(const fs::path& folder, const std::vector<ExportedFile>& files) {
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    make_folder((folder / file->path).parent_path());
    write_file(folder / file->path, file->bytes);
  }
}

}  // namespace

ExitCode run_command(const ExportOptions& options) {
  const std::string name = fs::path(options.robot).stem().string();
  const fs::path folder = options.folder.empty() ? name : options.folder;
  const std::vector<ExportedFile> files = exported(options, name);
  const fs::path robot_file = folder / files[0].path;
  if (!options.force && fs::exists(robot_file))
    return fail(ExitCode::kBadInput, robot_file.string() + ": already exists; --force replaces it");
  write_files(folder, files);
  print_text(printable_line(robot_file.string()) + ": with " + std::to_string(files.size() - 1) +
             " meshes\n");
  return ExitCode::kGood;
}

}  // namespace xr3
