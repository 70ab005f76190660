// The command line of a program as values, from which its manual pages and the completions of
// shells are made.
//
// The flow through the folder: cli/options/manual.hpp walks through the options that CLI11 knows
// and describes them as a DescribedProgram: its commands, and for each their options with names,
// type, default, environment variable and help. man_page.hpp writes the page of the program and of
// each command in the macros of man(7). completion.hpp writes a script for bash, zsh or fish; it
// derives from name and type of an option which values a shell can offer: the words of
// `paper|mark3`, files, or names of data files, which the script asks of `xr3 completion` at run
// time. The texts are printed by `xr3 manual` and `xr3 completion`, or written below share/ by `xr3
// manual --write`, which the build calls for packages. Since --help prints the same options, pages
// and completions cannot differ from it. Nothing here depends on CLI11 or opens a file.
#pragma once

#include <string>
#include <vector>

namespace xr3 {

/// An option, a flag or a positional argument.
struct DescribedOption {
  std::string name;           ///< with dashes; a positional argument has none
  std::string short_name;     ///< such as -h; may be empty
  std::string type;           ///< type of the value, such as PORT; empty for a flag
  std::string default_value;  ///< may be empty
  std::string environment;    ///< variable that sets it; may be empty
  std::string description;
  bool is_required = false;
  bool is_repeatable = false;
  bool is_positional() const { return !name.starts_with('-'); }
  bool takes_value() const { return !type.empty(); }
};

struct DescribedCommand {
  std::string name;
  std::string description;
  std::vector<DescribedOption> options;  ///< in the order of --help
};

struct DescribedProgram {
  std::string name;
  std::string version;
  std::string description;
  std::string notes;  ///< printed after every help text: exit codes
  std::vector<DescribedOption> options;
  std::vector<DescribedCommand> commands;
};

}  // namespace xr3
