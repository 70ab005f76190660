#include "server/options_config.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>

#include "server/options_environment.hpp"

namespace xr3 {
namespace {

using Lines = std::map<std::string, int>;  ///< where each key stands

[[noreturn]] void refuse(const std::string& place, const std::string& why) {
  throw CLI::ConfigError(place + ": " + why);
}

std::string without_comment(const std::string& line) {
  return CLI::detail::trim_copy(line.substr(0, line.find('#')));
}

/// What is wrong with a line that is not empty; nothing if CLI11 reads it as it is meant.
std::string trouble_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (text.starts_with('[')) return "sections have no meaning here: each line is KEY = VALUE";
  if (equals == std::string::npos || equals == 0) return "not KEY = VALUE";
  const std::string value = CLI::detail::trim_copy(text.substr(equals + 1));
  if (value.empty()) return "there is no value behind the =";
  const char quote = value.front() == '\'' ? '\'' : '"';
  if (std::count(value.begin(), value.end(), quote) % 2 != 0)
    return "a quote is not closed; a # begins a comment in quotes, too";
  if (value.starts_with('[') != value.ends_with(']'))
    return "a list stands on one line, as in [\"a\", \"b\"]";
  return {};
}

std::string key_of(const std::string& text) {
  std::string key = CLI::detail::trim_copy(text.substr(0, text.find('=')));
  return CLI::detail::remove_quotes(key);
}

/// Where the keys stand in a file that is as it should be.
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
      refuse(place, first->first + " stands on line " + std::to_string(first->second) + " already");
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
    refuse(place, "a secret has no place in this file; token-file names the file that holds it");
  refuse(place, "there is no such key; there are: " + allowed_keys(command));
}

void set(CLI::Option& option, const CLI::ConfigItem& item, const std::string& place) {
  if (std::find(item.inputs.begin(), item.inputs.end(), "") != item.inputs.end())
    refuse(place, "an empty value says nothing; leave the line out");
  if (item.inputs.size() > 1 && option.get_items_expected_max() == 1)
    refuse(place, "takes one value; one with blanks or commas stands in quotes");
  try {
    option.add_result(item.inputs);
    option.run_callback();
  } catch (const CLI::ParseError& error) {
    refuse(place, reason_of(option, error));
  }
}

DataFile read(const std::string& file, const Origins& origins) {
  try {
    return read_file(file);
  } catch (const FileError& error) {
    refuse(said_as(origins, "--config"), error.what());
  }
}

}  // namespace

void add_config(CLI::App& command, std::string& file) {
  command.add_option("--config", file, "options in a file: a line such as robot-port = 0 for each")
      ->type_name("FILE")
      ->configurable(false);
}

void take_config(CLI::App& command, const std::string& file, OtherKeys others, Origins& origins) {
  if (file.empty()) return;
  const DataFile config = read(file, origins);
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
    origins.emplace(option->get_name(), place);
  }
}

}  // namespace xr3
