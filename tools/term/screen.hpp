// The text that `xr3 term` writes to a terminal, so that replies and the line being typed do not
// mix: a reply begins a line of its own, and an edited line stays below it. Uses only CR, LF,
// blanks and backspaces, which every terminal supports.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "tools/term/line_editor.hpp"

namespace xr3::term {

class TermScreen {
 public:
  /// Shows characters of the line on which keys are typed;
  ///  ends it. Returns the text to write.
  std::string type(std::string_view echo);

  /// Shows text above the line being typed: one or more lines, with or without the last
  /// . Returns the text to write.
  std::string print(std::string_view lines);

  /// Shows the edited line behind a prompt, in this many columns; a longer one is scrolled. Returns
  /// the text to write.
  std::string edit(const LineEditor& editor, std::size_t columns);

  /// Ends the edited line, which stays on the screen. Returns the text to write.
  std::string end_edit();

  /// Whether nothing has been typed on the current line.
  bool is_at_line_start() const { return is_at_line_start_; }

 private:
  std::string erase_edit();

  bool is_at_line_start_ = true;
  std::string edited_;      ///< the prompt and the visible part of the edited line
  std::size_t cursor_ = 0;  ///< the column in `edited_`
};

}  // namespace xr3::term
