#include <filesystem>

#include "cli/commands/commands.hpp"
#include "protocol/text/printable.hpp"
#include "server/files/atomic_write.hpp"
#include "server/print.hpp"

namespace xr3 {

namespace fs = std::filesystem;

ExitCode run_command(const ManualFiles& manual) {
  for (const ManualFile& file : manual.files) {
    const fs::path path = fs::path(manual.folder) / file.path;
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) throw FileError(path.parent_path().string() + ": " + error.message());
    write_file(path, file.text);
  }
  print_text(printable_line(manual.folder) + ": " + std::to_string(manual.files.size()) +
             " files\n");
  return ExitCode::kGood;
}

}  // namespace xr3
