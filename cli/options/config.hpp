// Options from a config file: flat TOML, one `key = value` per line. CLI11 reads it but silently
// skips lines that it does not understand; such lines are errors here, reported with file and line.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>

#include "server/base/option_sources.hpp"

namespace xr3 {

/// The treatment of keys that are not options of the command.
enum class OtherKeys : std::uint8_t { kRefuse, kSkip };

/// Adds the option `--config`.
void add_config(CLI::App& command, std::string& file);

/// Sets the options that are not set yet to the values in the file, if `file` is not empty, and
/// adds their sources to `option_sources`. Throws CLI::ParseError, with the source of the file's
/// name if the file cannot be read.
void read_config(CLI::App& command, const std::string& file, OtherKeys others,
                 OptionSources& option_sources);

}  // namespace xr3
