#include "cli/manual/completion.hpp"

#include <algorithm>
#include <string_view>

namespace xr3 {
namespace {

bool is_plain_word(std::string_view text) {
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), is_allowed);
}

/// The alternatives A|B|C of a type, up to a bracket.
std::vector<std::string> alternatives_of(std::string_view type) {
  std::vector<std::string> words;
  while (!type.empty()) {
    const std::string_view part = type.substr(0, type.find('|'));
    type.remove_prefix(std::min(part.size() + 1, type.size()));
    const std::string_view word = part.substr(0, part.find('['));
    if (is_plain_word(word)) words.emplace_back(word);
  }
  return words;
}

bool is_of_files(std::string_view type) {
  for (const std::string_view part :
       {"FILE", "FOLDER", "PATH", "DEVICE", "OUT", "IN", "PROGRAM", "ZIP", ".json"}) {
    if (type.starts_with(part) || type.ends_with(part)) return true;
  }
  return false;
}

std::string data_kind_of(const DescribedOption& option) {
  if (option.name == "--robot") return "robots";
  if (option.name.ends_with("exercise")) return "exercises";
  if (option.name == "--workcell" || option.name == "--from") return "workcells";
  return option.name == "--fault" ? "faults" : "";
}

/// In single quotes, for every shell.
std::string shell_quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// With a backslash before each of these characters.
std::string with_backslashes(std::string_view text, std::string_view characters) {
  std::string out;
  for (const char c : text) {
    if (characters.find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string word_list(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : " ") + word;
  return out;
}

std::string completion_header(const DescribedProgram& program, const std::string& shell) {
  return "# Completion of " + program.name + " " + program.version + " for " + shell +
         ", made by `" + program.name + " completion " + shell + "`.\n";
}

std::string names_command(const DescribedProgram& program, const std::string& kind) {
  return program.name + " completion " + kind + " 2>/dev/null";
}

// ---- bash

std::string bash_assignments(const DescribedProgram& program, const ValueChoices& choices) {
  std::string out;
  if (!choices.words.empty()) out += " words=" + shell_quoted(word_list(choices.words));
  if (!choices.data_kind.empty())
    out += " words=$(" + names_command(program, choices.data_kind) + ")";
  if (choices.has_files) out += " files=1";
  return out.empty() ? " return" : out;
}

std::vector<std::string> option_names(const std::vector<DescribedOption>& options) {
  std::vector<std::string> names;
  for (const DescribedOption& option : options) {
    if (!option.is_positional()) names.push_back(option.name);
  }
  return names;
}

std::string bash_cases(const DescribedProgram& program, const DescribedCommand& command) {
  std::string out;
  ValueChoices otherwise{option_names(command.options), "", false};
  for (const DescribedOption& option : command.options) {
    const ValueChoices choices = choices_of(option);
    if (option.is_positional()) {
      otherwise.has_files = otherwise.has_files || choices.has_files;
      otherwise.words.insert(otherwise.words.end(), choices.words.begin(), choices.words.end());
    } else if (option.takes_value()) {
      out += "    " + command.name + "," + option.name + ")" + bash_assignments(program, choices) +
             " ;;\n";
    }
  }
  return out + "    " + command.name + ",*)" + bash_assignments(program, otherwise) + " ;;\n";
}

std::vector<std::string> command_names(const DescribedProgram& program) {
  std::vector<std::string> names;
  for (const DescribedCommand& command : program.commands) names.push_back(command.name);
  return names;
}

// ---- zsh

std::string zsh_action(const ValueChoices& choices) {
  if (!choices.data_kind.empty()) return "_xr3_names " + choices.data_kind;
  if (!choices.words.empty()) return "(" + word_list(choices.words) + ")";
  return choices.has_files ? "_files" : " ";
}

std::string zsh_value(const DescribedOption& option) {
  return ":" + with_backslashes(option.type, ":\\") + ":" + zsh_action(choices_of(option));
}

std::string zsh_argument(const DescribedOption& option) {
  if (option.is_positional()) {
    const std::string place = option.is_repeatable ? "*" : option.is_required ? "" : ":";
    return shell_quoted(place + zsh_value(option));
  }
  std::string text = option.is_repeatable ? "*" : "";
  text += option.name + (option.takes_value() ? "=" : "");
  text += "[" + with_backslashes(option.description, "[]\\:") + "]";
  if (option.takes_value()) text += zsh_value(option);
  return shell_quoted(text);
}

/// A call of _arguments; `flags` are its own options, which come first.
std::string zsh_arguments(const std::string& flags, const std::vector<DescribedOption>& options,
                          const std::string& indent) {
  std::string out = indent + "_arguments " + flags;
  for (const DescribedOption& option : options)
    out += " \\\n" + indent + "  " + zsh_argument(option);
  return out;
}

// ---- fish

std::string fish_value(const DescribedProgram& program, const DescribedOption& option) {
  const ValueChoices choices = choices_of(option);
  std::string out = choices.has_files ? " -r -F" : " -x";
  if (!choices.words.empty()) out += " -a " + shell_quoted(word_list(choices.words));
  if (!choices.data_kind.empty())
    out += " -a " + shell_quoted("(" + names_command(program, choices.data_kind) + ")");
  return out;
}

std::string fish_option(const DescribedProgram& program, const std::string& condition,
                        const DescribedOption& option) {
  std::string out = "complete -c " + program.name + " -n " + shell_quoted(condition);
  if (!option.is_positional()) out += " -l " + option.name.substr(2);
  if (option.is_positional() && !choices_of(option).has_files) {
    const std::string words = word_list(choices_of(option).words);
    return words.empty() ? "" : out + " -a " + shell_quoted(words) + "\n";
  }
  if (option.is_positional()) return out + " -F\n";
  if (option.takes_value()) out += fish_value(program, option);
  return out + " -d " + shell_quoted(option.description) + "\n";
}

}  // namespace

ValueChoices choices_of(const DescribedOption& option) {
  if (!option.takes_value()) return {};
  return {alternatives_of(option.type), data_kind_of(option), is_of_files(option.type)};
}

std::string bash_completion(const DescribedProgram& program) {
  const std::vector<std::string> commands = command_names(program);
  std::string cases;
  for (const DescribedCommand& command : program.commands) cases += bash_cases(program, command);
  std::vector<std::string> first = commands;
  for (const std::string& name : option_names(program.options)) first.push_back(name);
  return completion_header(program, "bash") +
         "_xr3() {\n"
         "  local word=$2 before=$3 command= words= files= part\n"
         "  COMPREPLY=()\n"
         "  if [ \"$word\" = = ]; then word=; elif [ \"$before\" = = ]; then "
         "before=${COMP_WORDS[COMP_CWORD - 2]}; fi\n"
         "  for part in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
         "    case $part in --) before=-- command= files=1; break ;; esac\n"
         "    [ -n \"$command\" ] || case $part in [a-z]*) command=$part ;; esac\n"
         "  done\n"
         "  case $command,$before in\n"
         "    ,--) ;;\n" +
         cases + "    ,*) words=" + shell_quoted(word_list(first)) +
         " ;;\n"
         "  esac\n"
         "  [ -z \"$files\" ] || compopt -o filenames 2>/dev/null\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\"; "
         "[ -z \"$files\" ] || compgen -f -- \"$word\")\n"
         "}\n"
         "complete -F _xr3 " +
         program.name + "\n";
}

std::string zsh_completion(const DescribedProgram& program) {
  std::string commands;
  std::string cases;
  for (const DescribedCommand& command : program.commands) {
    commands += "    " +
                shell_quoted(command.name + ":" + with_backslashes(command.description, ":")) +
                "\n";
    cases += "        " + command.name + ")\n" +
             zsh_arguments("-s", command.options, "          ") + "\n          ;;\n";
  }
  return "#compdef " + program.name + "\n" + completion_header(program, "zsh") +
         "# _arguments puts options of compadd before the kind of data files.\n"
         "_xr3_names() {\n"
         "  local -a names\n"
         "  names=(${(f)\"$(" +
         program.name +
         " completion ${argv[-1]} 2>/dev/null)\"})\n"
         "  compadd \"${(@)argv[1,-2]}\" -a names\n"
         "  _files\n"
         "}\n"
         "_xr3() {\n"
         "  local context state line\n"
         "  local -a commands\n"
         "  commands=(\n" +
         commands + "  )\n" + zsh_arguments("-s -C", program.options, "  ") +
         " \\\n    '1:command:->command' '*::argument:->argument'\n"
         "  case $state in\n"
         "    command) _describe command commands ;;\n"
         "    argument)\n"
         "      case $line[1] in\n" +
         cases +
         "      esac\n"
         "      ;;\n"
         "  esac\n"
         "}\n"
         "_xr3 \"$@\"\n";
}

std::string fish_completion(const DescribedProgram& program) {
  std::string out = completion_header(program, "fish") + "complete -c " + program.name + " -f\n";
  for (const DescribedOption& option : program.options)
    out += fish_option(program, "__fish_use_subcommand", option);
  for (const DescribedCommand& command : program.commands) {
    out += "complete -c " + program.name + " -n __fish_use_subcommand -a " + command.name + " -d " +
           shell_quoted(command.description) + "\n";
    for (const DescribedOption& option : command.options)
      out += fish_option(program, "__fish_seen_subcommand_from " + command.name, option);
  }
  return out;
}

}  // namespace xr3
