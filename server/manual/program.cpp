#include "server/manual/program.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace xr3 {
namespace {

std::string first_or_empty(const std::vector<std::string>& names, const std::string& dashes) {
  return names.empty() ? std::string() : dashes + names.front();
}

DescribedOption describe_option(const CLI::Option& option) {
  DescribedOption text;
  text.name =
      option.get_positional() ? option.get_name(true) : first_or_empty(option.get_lnames(), "--");
  text.short_name = first_or_empty(option.get_snames(), "-");
  if (option.get_type_size() != 0) text.type = option.get_type_name();
  text.default_value = option.get_default_str();
  text.environment = option.get_envname();
  text.description = option.get_description();
  text.is_required = option.get_required();
  text.is_repeatable = option.get_expected_max() == CLI::detail::expected_max_vector_size;
  return text;
}

std::vector<DescribedOption> describe_options(const CLI::App& app) {
  std::vector<DescribedOption> texts;
  for (const CLI::Option* option : app.get_options()) texts.push_back(describe_option(*option));
  return texts;
}

}  // namespace

DescribedProgram describe_program(const CLI::App& app, const std::string& version) {
  DescribedProgram program{app.get_name(),        version, app.get_description(), app.get_footer(),
                           describe_options(app), {}};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    program.commands.push_back(
        {command->get_name(), command->get_description(), describe_options(*command)});
  }
  return program;
}

const DescribedCommand* find_command(const DescribedProgram& program, const std::string& name) {
  const auto found = std::find_if(program.commands.begin(), program.commands.end(),
                                  [&](const DescribedCommand& c) { return c.name == name; });
  return found == program.commands.end() ? nullptr : &*found;
}

}  // namespace xr3
