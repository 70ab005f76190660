#include "cli/options/manual.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <utility>

#include "cli/manual/completion.hpp"
#include "cli/manual/man_page.hpp"
#include "cli/options/pose_argument.hpp"
#include "cli/options/shared_options.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

constexpr std::array kDataKinds = {"robots", "workcells", "faults", "exercises"};

std::string command_list(const DescribedProgram& program) {
  std::string list;
  for (const DescribedCommand& command : program.commands)
    list += (list.empty() ? "" : ", ") + command.name;
  return list;
}

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

DescribedProgram describe_program(const CLI::App& app) {
  DescribedProgram program{app.get_name(),   XR3_VERSION,           app.get_description(),
                           app.get_footer(), describe_options(app), {}};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    program.commands.push_back(
        {command->get_name(), command->get_description(), describe_options(*command)});
  }
  return program;
}

}  // namespace

void add_manual(CLI::App& app, ManualOptions& options) {
  CLI::App& manual =
      *app.add_subcommand("manual", "print the manual page of a command, for example to man -l -");
  CLI::Option* command = add_value(manual, "command", options.command, "COMMAND",
                                   "the command; without it, the page of xr3");
  add_value(manual, "--write", options.folder, "FOLDER",
            "write all pages and the completions of all shells below this folder")
      ->excludes(command);
}

void add_completion(CLI::App& app, ManualOptions& options) {
  app.add_subcommand("completion", "print a script that completes xr3's command line in a shell")
      ->add_option("shell", options.completion,
                   "the shell; or the kind of data files whose names are printed")
      ->type_name("bash|zsh|fish|robots|workcells|faults|exercises")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish", "robots", "workcells", "faults", "exercises"})
                  .description(""));
}

std::string manual_page(const CLI::App& app, const ManualOptions& options) {
  const DescribedProgram program = describe_program(app);
  if (options.command.empty()) return man_page(program);
  const auto command =
      std::ranges::find(program.commands, options.command, &DescribedCommand::name);
  if (command == program.commands.end())
    throw ArgumentError("there is no command " + options.command +
                        "; use one of: " + command_list(program));
  return man_page(program, *command);
}

std::string completion_text(const CLI::App& app, const ManualOptions& options) {
  if (std::find(kDataKinds.begin(), kDataKinds.end(), options.completion) != kDataKinds.end()) {
    std::string lines;
    const auto names = options.completion == "exercises" ? names_of_exercises()
                                                         : names_of_data_files(options.completion);
    for (const std::string& name : names) lines += name + "\n";
    return lines;
  }
  const DescribedProgram program = describe_program(app);
  if (options.completion == "bash") return bash_completion(program);
  return options.completion == "zsh" ? zsh_completion(program) : fish_completion(program);
}

std::vector<ManualFile> manual_files(const CLI::App& app) {
  const DescribedProgram program = describe_program(app);
  std::vector<ManualFile> files = {
      {"man/man1/xr3.1", man_page(program)},
      {"bash-completion/completions/xr3", bash_completion(program)},
      {"zsh/vendor-completions/_xr3", zsh_completion(program)},
      {"fish/vendor_completions.d/xr3.fish", fish_completion(program)},
  };
  for (const DescribedCommand& command : program.commands)
    files.push_back({"man/man1/xr3-" + command.name + ".1", man_page(program, command)});
  return files;
}

}  // namespace xr3
