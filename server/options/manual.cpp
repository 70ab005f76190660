#include "server/options/manual.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <utility>

#include "server/files/data_files.hpp"
#include "server/manual/completion.hpp"
#include "server/manual/man_page.hpp"
#include "server/options/pose_argument.hpp"

namespace xr3 {
namespace {

constexpr std::array kDataKinds = {"robots", "workcells", "faults"};

std::string command_list(const DescribedProgram& program) {
  std::string list;
  for (const DescribedCommand& command : program.commands)
    list += (list.empty() ? "" : ", ") + command.name;
  return list;
}

DescribedProgram program_of(const CLI::App& app) { return describe_program(app, XR3_VERSION); }

}  // namespace

void add_manual(CLI::App& app, ManualOptions& options) {
  CLI::App& manual =
      *app.add_subcommand("manual", "print the manual page of a command, for example to man -l -");
  CLI::Option* command =
      manual.add_option("command", options.command, "the command; without it, the page of xr3")
          ->type_name("COMMAND");
  manual
      .add_option("--write", options.folder,
                  "write all pages and the completions of all shells below this folder")
      ->type_name("FOLDER")
      ->excludes(command);
}

void add_completion(CLI::App& app, ManualOptions& options) {
  app.add_subcommand("completion", "print a script that completes xr3's command line in a shell")
      ->add_option("shell", options.completion,
                   "the shell; or the kind of data files whose names are printed")
      ->type_name("bash|zsh|fish|robots|workcells|faults")
      ->required()
      ->check(
          CLI::IsMember({"bash", "zsh", "fish", "robots", "workcells", "faults"}).description(""));
}

std::string manual_page(const CLI::App& app, const ManualOptions& options) {
  const DescribedProgram program = program_of(app);
  if (options.command.empty()) return man_page(program);
  const DescribedCommand* command = find_command(program, options.command);
  if (command == nullptr) {
    throw ArgumentError("there is no command " + options.command +
                        "; use one of: " + command_list(program));
  }
  return man_page(program, *command);
}

std::string completion_text(const CLI::App& app, const ManualOptions& options) {
  if (std::find(kDataKinds.begin(), kDataKinds.end(), options.completion) != kDataKinds.end()) {
    std::string lines;
    for (const std::string& name : names_of_data_files(options.completion)) lines += name + "\n";
    return lines;
  }
  const DescribedProgram program = program_of(app);
  if (options.completion == "bash") return bash_completion(program);
  return options.completion == "zsh" ? zsh_completion(program) : fish_completion(program);
}

std::vector<ManualFile> manual_files(const CLI::App& app) {
  const DescribedProgram program = program_of(app);
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
