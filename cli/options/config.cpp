#include "cli/options/config.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>

#include "cli/options/environment.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

using Lines = std::map<std::string, int>;  ///< line number of each key

[[noreturn]] void refuse(const std::string& place, const std::string& why) {
  throw CLI::ConfigError(place + ": " + why);
}

std::string without_comment(const std::string& line) {
  return CLI::detail::trim_copy(line.substr(0, line.find('#')));
}

/// The error in a line that is not empty; empty if CLI11 reads the line as intended.
std::string trouble_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (text.starts_with('[')) return "sections are not supported: each line is KEY = VALUE";
  if (equals == std::string::npos || equals == 0) return "not KEY = VALUE";
  const std::string value = CLI::detail::trim_copy(text.substr(equals + 1));
  if (value.empty()) return "there is no value after the =";
  const char quote = value.front() == '\'' ? '\'' : '"';
  if (std::count(value.begin(), value.end(), quote) % 2 != 0)
    return "a quote is not closed; # begins a comment, even in quotes";
  if (value.starts_with('[') != value.ends_with(']'))
    return "a list must be on one line, as in [\"a\", \"b\"]";
  return {};
}

std::string key_of(const std::string& text) {
  std::string key = CLI::detail::trim_copy(text.substr(0, text.find('=')));
  return CLI::detail::remove_quotes(key);
}

/// Checks the lines of the file; returns the line number of each key.
Lines lines_of(const DataFile& file) {
  Lines lines;
  std::istringstream text(file.text);
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    const std::string place = file.path + ":" + std::to_string(++number);
    line = CLI::detail::trim_copy(line);
    const bool is_old_comment = line.starts_with(';');
    line = without_comment(line);
    if (line.empty() || is_old_comment) continue;
    if (const std::string trouble = trouble_of(line); !trouble.empty()) refuse(place, trouble);
    const auto [first, is_new] = lines.emplace(key_of(line), number);
    if (!is_new)
      refuse(place, first->first + " is already set on line " + std::to_string(first->second));
  }
  return lines;
}

std::string place_of(const std::string& key, const std::string& file, const Lines& lines) {
  const auto line = lines.find(key);
  const std::string number = line == lines.end() ? "" : ":" + std::to_string(line->second);
  return file + number + ": " + key;
}

std::string allowed_keys(const CLI::App& command) {
  std::string keys;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_configurable()) keys += (keys.empty() ? "" : ", ") + option->get_single_name();
  }
  return keys;
}

CLI::Option* find_option(CLI::App& command, const std::string& key) {
  CLI::Option* option = command.get_option_no_throw("--" + key);
  return option != nullptr && option->get_configurable() ? option : nullptr;
}

[[noreturn]] void refuse_key(const CLI::App& command, const std::string& key,
                             const std::string& place) {
  if (key == "token")
    refuse(place, "the token must not be in this file; token-file names a file that contains it");
  refuse(place, "unknown key; use one of: " + allowed_keys(command));
}

void set(CLI::Option& option, const CLI::ConfigItem& item, const std::string& place) {
  if (std::find(item.inputs.begin(), item.inputs.end(), "") != item.inputs.end())
    refuse(place, "the value is empty; remove the line instead");
  if (item.inputs.size() > 1 && option.get_items_expected_max() == 1)
    refuse(place, "takes one value; put a value with blanks or commas in quotes");
  try {
    option.add_result(item.inputs);
    option.run_callback();
  } catch (const CLI::ParseError& error) {
    refuse(place, reason_of(option, error));
  }
}

DataFile read(const std::string& file, const OptionSources& option_sources) {
  try {
    return read_file(file);
  } catch (const FileError& error) {
    refuse(source_of(option_sources, "--config"), error.what());
  }
}

}  // namespace

void add_config(CLI::App& command, std::string& file) {
  command.add_option("--config", file, "file with options, one per line, such as robot-port = 0")
      ->type_name("FILE")
      ->configurable(false);
}

void read_config(CLI::App& command, const std::string& file, OtherKeys others,
                 OptionSources& option_sources) {
  if (file.empty()) return;
  const DataFile config = read(file, option_sources);
  const Lines lines = lines_of(config);
  std::istringstream text(config.text);
  for (const CLI::ConfigItem& item : command.get_config_formatter()->from_config(text)) {
    const std::string key = item.fullname();
    const std::string place = place_of(key, file, lines);
    CLI::Option* option = find_option(command, key);
    if (option == nullptr && others == OtherKeys::kSkip) continue;
    if (option == nullptr) refuse_key(command, key, place);
    if (option->count() > 0) continue;
    set(*option, item, place);
    option_sources.emplace(option->get_name(), place);
  }
}

}  // namespace xr3
