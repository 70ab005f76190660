// The command lines of `xr3 manual` and `xr3 completion`, whose output is made from the options of
// all commands.
#pragma once

#include <string>
#include <vector>

#include "cli/options/cli_fwd.hpp"

namespace xr3 {

struct ManualOptions {
  std::string command;     ///< command of the page; empty for that of xr3
  std::string folder;      ///< folder to write all files below; empty to print one page
  std::string completion;  ///< a shell, or a kind of data files whose names are printed
};

/// A file below the folder of `xr3 manual --write`.
struct ManualFile {
  std::string path;  ///< relative, such as man1/xr3-serve.1
  std::string text;
};

void add_manual(CLI::App& app, ManualOptions& options);
void add_completion(CLI::App& app, ManualOptions& options);

/// The text that `xr3 manual` prints. Throws ArgumentError if there is no such command.
std::string manual_page(const CLI::App& app, const ManualOptions& options);

/// The text that `xr3 completion` prints. Throws FileError if there is no data folder.
std::string completion_text(const CLI::App& app, const ManualOptions& options);

/// All pages and completions, at their places below share/.
std::vector<ManualFile> manual_files(const CLI::App& app);

}  // namespace xr3
