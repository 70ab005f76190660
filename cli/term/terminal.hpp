// Full-screen output and key input on the terminal, by ncurses, which only terminal.cpp includes.
// Handles no signal except that of Ctrl-Z.
#pragma once

#include <memory>
#include <optional>

#include "tools/text/screen.hpp"
#include "tools/watch/command_mode.hpp"

namespace xr3 {

enum class Colors : std::uint8_t { kYes, kNo };

/// Whether standard output is a terminal.
bool is_terminal();
/// kUnicode if the encoding of the locale is UTF-8.
Letters letters_of_locale();

struct TerminalSize {
  int rows = 24;
  int columns = 80;
};
/// The size of the terminal on standard output; without one LINES and COLUMNS, or 24 x 80.
TerminalSize terminal_size();

class Terminal {
 public:
  /// Switches to full-screen mode. Throws std::runtime_error if the type of the terminal cannot
  /// move its cursor.
  Terminal(Letters letters, Colors colors);
  /// Restores the terminal.
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Displays the screen; sends only the differences to the previous one.
  void show(const TextScreen& screen);
  /// Call after the size of the terminal has changed. The next show() repaints everything.
  void resize();

  /// The next key from the input queue; nullopt if it is empty. Alt is recognised in the sequences
  /// of xterm and of terminals that send an escape first.
  std::optional<watch::ModeKey> key();

 private:
  struct Screen;
  Letters letters_;
  std::unique_ptr<Screen> screen_;
};

}  // namespace xr3
