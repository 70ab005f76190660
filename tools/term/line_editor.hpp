// A line that is edited before it is sent, with the history of earlier lines. A value; screen.hpp
// shows it. Only printable ASCII, which is all that robots understand.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/term/keystroke.hpp"

namespace xr3::term {

class LineEditor {
 public:
  static constexpr std::size_t kMaxBytes = 1000;
  static constexpr std::size_t kMaxHistory = 1000;

  /// The result of a key: a line is complete, or the user quits.
  enum class Result : std::uint8_t { kNothing, kLine, kQuit };

  /// Handles a key. After kLine, line() is the line and text() is empty. Ctrl-D on an empty line
  /// quits; Ctrl-C clears the line, and quits if it is empty.
  Result press(const Keystroke& key);

  const std::string& line() const { return line_; }
  const std::string& text() const { return text_; }
  /// The position of the next character, 0...text().size().
  std::size_t cursor() const { return cursor_; }

 private:
  void press_byte(char byte);
  void move(KeyCode code);
  void recall(std::size_t entry);
  void erase(std::size_t from, std::size_t to);
  Result finish();

  std::string text_;
  std::size_t cursor_ = 0;
  std::string line_;
  std::vector<std::string> history_;  ///< oldest first
  std::size_t shown_ = 0;             ///< the entry of history_ that text_ was, or its size
  std::string draft_;                 ///< the new line, while an entry is shown
};

}  // namespace xr3::term
