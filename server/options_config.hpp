// Options that may come from a file: flat TOML, a `key = value` a line, read by CLI11, which skips what
// it does not understand; what it would skip is refused here, with file and line.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>

#include "server/origins.hpp"

namespace xr3 {

/// What becomes of keys that are no options of the command.
enum class OtherKeys : std::uint8_t { kRefuse, kSkip };

/// The option `--config`, and XR3_CONFIG.
void add_config(CLI::App& command, std::string& file);

/// Gives the options that were found nowhere else the values that the file has; adds to `origins`,
/// which name the place that names the file. Nothing where no file is named. Throws CLI::ParseError.
void take_config(CLI::App& command, const std::string& file, OtherKeys others, Origins& origins);

}  // namespace xr3
