#include "cli/options/environment.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace xr3 {
namespace {

std::string variable_of(const std::string& option) {
  std::string name = "XR3_" + option.substr(2);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return c == '-' ? '_' : std::toupper(c); });
  return name;
}

bool is_from_environment(const CLI::App& command, const CLI::Option& option) {
  const std::string name = option.get_envname();
  if (name.empty() || is_argument(command, option.get_name())) return false;
  const char* value = std::getenv(name.c_str());
  return value != nullptr && *value != '\0';
}

}  // namespace

void read_environment(CLI::App& command, const std::set<std::string>& except) {
  for (CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option != command.get_help_ptr() && !except.contains(name))
      option->envname(variable_of(name));
  }
}

bool is_argument(const CLI::App& command, const std::string& name) {
  const std::vector<CLI::Option*>& arguments = command.parse_order();
  return std::find(arguments.begin(), arguments.end(), command.get_option(name)) != arguments.end();
}

OptionSources complete_from_environment(CLI::App& command) {
  OptionSources option_sources;
  for (CLI::Option* option : command.get_options()) {
    if (!is_from_environment(command, *option)) continue;
    if (option->count() == 0) {
      option->add_result(std::getenv(option->get_envname().c_str()));
      option->run_callback();
    }
    option_sources.emplace(option->get_name(), option->get_envname());
  }
  return option_sources;
}

std::optional<std::string> problem_in_environment(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    if (!is_from_environment(command, *option)) continue;
    try {
      option->run_callback();
    } catch (const CLI::ParseError& error) {
      return option->get_envname() + ": " + reason_of(*option, error);
    }
  }
  return {};
}

std::string reason_of(const CLI::Option& option, const CLI::Error& error) {
  const std::string text = error.what();
  const std::string before = option.get_name() + ": ";
  return text.starts_with(before) ? text.substr(before.size()) : text;
}

}  // namespace xr3
