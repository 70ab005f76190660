// Scripts that complete a program's command line in a shell.
#pragma once

#include <string>
#include <vector>

#include "cli/manual/program.hpp"

namespace xr3 {

/// The values that a shell offers for an option.
struct ValueChoices {
  std::vector<std::string> words;
  std::string data_kind;  ///< names in this folder of the data, such as robots; may be empty
  bool has_files = false;
  bool operator==(const ValueChoices&) const = default;
};

/// The choices follow from the option's name and type: `paper|mark3` are words, FILE is a file.
ValueChoices choices_of(const DescribedOption& option);

/// The script for this shell. bash, zsh and fish complete commands, options, values and files.
std::string bash_completion(const DescribedProgram& program);
std::string zsh_completion(const DescribedProgram& program);
std::string fish_completion(const DescribedProgram& program);

}  // namespace xr3
