// The command line of `xr3 export`.
#pragma once

#include <cstdint>
#include <string>

#include "cli/options/cli_fwd.hpp"

namespace xr3 {

enum class ExportForm : std::uint8_t { kUrdf, kMjcf };

struct ExportOptions {
  ExportForm form = ExportForm::kUrdf;
  std::string robot;   ///< name or path
  std::string folder;  ///< empty for one with the robot's name, in the current folder
  bool force = false;  ///< replace an existing file
};

void add_export(CLI::App& app, ExportOptions& options);

}  // namespace xr3
