// The command line of a program as values, from which its manual pages and the completions of
// shells are made.
#pragma once

#include <string>
#include <vector>

namespace xr3 {

/// An option, a flag or a positional argument.
struct DescribedOption {
  std::string name;           ///< with its dashes; that of a positional argument has none
  std::string short_name;     ///< such as -h; may be empty
  std::string type;           ///< of its value, such as PORT; empty: a flag
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
