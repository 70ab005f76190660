#include "cli/manual/man_page.hpp"

#include <string_view>

namespace xr3 {
namespace {

/// Text in which roff finds no request, no escape and no hyphen that is a dash.
std::string roff_text(std::string_view text) {
  std::string out;
  bool is_line_start = true;
  for (const char c : text) {
    if (is_line_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    is_line_start = c == '\n';
  }
  return out;
}

std::string in_bold(const std::string& text) { return "\\fB" + roff_text(text) + "\\fR"; }
std::string in_italics(const std::string& text) { return "\\fI" + roff_text(text) + "\\fR"; }

std::string upper_case(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

std::string page_title(const DescribedProgram& program, const std::string& page) {
  return ".TH " + roff_text(upper_case(page)) + " 1 \"\" \"" + program.name + " " +
         program.version + "\" \"Manual of " + program.name + "\"\n";
}

std::string name_section(const std::string& page, std::string_view description) {
  return ".SH NAME\n" + roff_text(page) + " \\- " + roff_text(description) + "\n";
}

/// The first line of `NAME: what it is.`, without the name and the full stop.
std::string_view summary_of(const DescribedProgram& program) {
  std::string_view line = program.description;
  line = line.substr(0, line.find('\n'));
  if (line.starts_with(program.name + ": ")) line.remove_prefix(program.name.size() + 2);
  if (line.ends_with('.')) line.remove_suffix(1);
  return line;
}

std::string synopsis_of(const DescribedOption& positional) {
  const std::string name = in_italics(positional.type.empty() ? positional.name : positional.type) +
                           (positional.is_repeatable ? "..." : "");
  return positional.is_required ? name : "[" + name + "]";
}

std::string synopsis(const DescribedProgram& program, const DescribedCommand& command) {
  std::string line =
      in_bold(program.name + " " + command.name) + " [" + in_italics("OPTION") + "...]";
  for (const DescribedOption& option : command.options) {
    if (option.is_positional()) line += " " + synopsis_of(option);
  }
  return ".SH SYNOPSIS\n" + line + "\n";
}

std::string option_head(const DescribedOption& option) {
  if (option.is_positional()) return synopsis_of(option);
  std::string head = option.short_name.empty() ? "" : in_bold(option.short_name) + ", ";
  head += in_bold(option.name);
  if (option.takes_value()) head += " " + in_italics(option.type);
  return head;
}

std::string option_notes(const DescribedOption& option) {
  std::string notes;
  if (!option.default_value.empty()) notes += "\nDefault: " + roff_text(option.default_value) + ".";
  if (option.is_repeatable && !option.is_positional()) notes += "\nIt may be repeated.";
  if (!option.environment.empty()) notes += "\nEnvironment: " + in_bold(option.environment) + ".";
  return notes;
}

std::string roff_sentence(const std::string& text) {
  return roff_text(text) + (text.ends_with('.') ? "" : ".");
}

std::string options_section(const std::vector<DescribedOption>& options) {
  std::string text = ".SH OPTIONS\n";
  for (const DescribedOption& option : options) {
    text += ".TP\n" + option_head(option) + "\n" + roff_sentence(option.description) +
            option_notes(option) + "\n";
  }
  return text;
}

std::string preformatted(const std::string& heading, const std::string& text) {
  return ".SH " + heading + "\n.nf\n" + roff_text(text) + "\n.fi\n";
}

}  // namespace

std::string man_page(const DescribedProgram& program) {
  std::string page = page_title(program, program.name) +
                     name_section(program.name, summary_of(program)) + ".SH SYNOPSIS\n" +
                     in_bold(program.name) + " " + in_italics("COMMAND") + " [" +
                     in_italics("OPTION") + "...]\n.SH DESCRIPTION\n" +
                     roff_text(program.description) + "\n.SH COMMANDS\n";
  for (const DescribedCommand& command : program.commands) {
    page += ".TP\n" + in_bold(program.name + "-" + command.name) + "(1)\n" +
            roff_sentence(command.description) + "\n";
  }
  return page + options_section(program.options) + preformatted("EXIT STATUS", program.notes);
}

std::string man_page(const DescribedProgram& program, const DescribedCommand& command) {
  const std::string name = program.name + "-" + command.name;
  return page_title(program, name) + name_section(name, command.description) +
         synopsis(program, command) + options_section(command.options) +
         preformatted("EXIT STATUS", program.notes) + ".SH SEE ALSO\n" + in_bold(program.name) +
         "(1)\n";
}

}  // namespace xr3
