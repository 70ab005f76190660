#include "cli/options/argument_error.hpp"

#include <CLI/Option.hpp>
#include <algorithm>

#include "cli/options/environment.hpp"
#include "protocol/json/codec.hpp"
#include "protocol/text/printable.hpp"

namespace xr3 {
namespace {

using ArgumentList = std::vector<std::string>;

constexpr std::size_t kCommandColumns = 11;  // columns of the longest name

/// The subcommand that was given; the program itself if there was none.
const CLI::App& command_of(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app : *commands.front();
}

std::string name_of(const CLI::App& command) {
  return command.get_parent() == nullptr ? "xr3" : "xr3 " + command.get_name();
}

std::string help_on(const CLI::App& command) {
  const std::string what = command.get_parent() == nullptr ? "commands" : "arguments";
  return "; " + name_of(command) + " --help lists the " + what;
}

std::string perhaps(std::string_view word, const ArgumentList& known) {
  const std::string nearest = data::nearest_name(word, known);
  return nearest.empty() ? "" : "; perhaps " + nearest + " was meant";
}

/// The names that end with this option, such as --robot-port for --port; else the nearest.
std::string perhaps_option(const std::string& name, const ArgumentList& known) {
  std::string longer;
  for (const std::string& each : known)
    if (name.starts_with("--") && each.ends_with(name.substr(1)))
      longer += (longer.empty() ? "" : " or ") + each;
  return longer.empty() ? perhaps(name, known) : "; perhaps " + longer + " was meant";
}

ArgumentList options_of(const CLI::App& command) {
  ArgumentList names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

ArgumentList commands_of(const CLI::App& app) {
  ArgumentList names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// A line for each command.
std::string list_of_commands(const CLI::App& app) {
  std::string list;
  for (const CLI::App* command : app.get_subcommands({})) {
    std::string name = command->get_name();
    name.resize(std::max(name.size(), kCommandColumns), ' ');
    list += "\n  " + name + "  " + command->get_description();
  }
  return list;
}

/// The unexpected arguments. The library counts the `--` before the arguments of another program.
ArgumentList extras_of(const CLI::App& app) {
  ArgumentList extras = app.remaining(true);
  std::erase(extras, "--");
  return extras;
}

/// The first unexpected argument of the program.
std::string first_extra(const CLI::App& app, const ArgumentList& arguments) {
  const ArgumentList extras = extras_of(app);
  const auto is_extra = [&extras](const std::string& argument) {
    return std::find(extras.begin(), extras.end(), argument) != extras.end();
  };
  const auto first = std::find_if(arguments.begin(), arguments.end(), is_extra);
  return first == arguments.end() ? extras.front() : *first;
}

bool is_before(const std::string& word, const std::string& command, const ArgumentList& arguments) {
  return std::find(arguments.begin(), arguments.end(), word) <
         std::find(arguments.begin(), arguments.end(), command);
}

std::string unexpected(const CLI::App& app, const ArgumentList& arguments) {
  const CLI::App& command = command_of(app);
  const std::string word = first_extra(app, arguments);
  if (&command == &app && !word.starts_with('-'))
    return "unknown command " + word + perhaps(word, commands_of(app)) + help_on(app);
  if (!word.starts_with('-')) return "unexpected argument " + word + help_on(command);
  const std::string name = word.substr(0, word.find('='));
  if (&command != &app && is_before(word, command.get_name(), arguments))
    return name + " must follow the command, as in " + name_of(command) + " " + name;
  return name_of(command) + " has no option " + name + perhaps_option(name, options_of(command)) +
         help_on(command);
}

/// The option whose name begins the library's message, `NAME: ...` or `NAME is required`.
const CLI::Option* option_in(const CLI::App& command, const std::string& message) {
  const std::string name = message.substr(0, message.find_first_of(": "));
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_name() == name || option->get_single_name() == name) return option;
  }
  return nullptr;
}

/// The sentence for a value or an argument that is missing, or one too many.
std::string miscounted(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = command_of(app);
  const CLI::Option* option = option_in(command, error.what());
  if (option == nullptr) return error.what() + help_on(command);
  if (option->get_positional())
    return name_of(command) + " needs " + option->get_type_name() + help_on(command);
  return option->get_name() + " needs one value, " + option->get_type_name() + help_on(command);
}

}  // namespace

std::string describe_argument_error(const CLI::App& app, const CLI::ParseError& error,
                                    const std::vector<std::string>& arguments) {
  for (CLI::App* command : app.get_subcommands()) {
    const auto trouble = problem_in_environment(*command);
    if (trouble) return printable_line(*trouble + help_on(*command));
  }
  const std::string kind = error.get_name();
  const CLI::App& command = command_of(app);
  if (kind == "RequiredError" && &command == &app && extras_of(app).empty())
    return "a command is missing; xr3 COMMAND --help says more" + list_of_commands(app);
  if (!extras_of(app).empty()) return printable_line(unexpected(app, arguments));
  if (kind == "ArgumentMismatch" || kind == "RequiredError")
    return printable_line(miscounted(app, error));
  return printable_line(error.what() + help_on(command));
}

}  // namespace xr3
