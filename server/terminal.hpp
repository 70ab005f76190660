// The terminal that xr3 was started in, as a place for whole screens and a source of keys. ncurses is
// behind it and nowhere else. It catches no signal of its own but that of Ctrl-Z.
#pragma once

#include <memory>
#include <optional>

#include "protocol/text_screen.hpp"

namespace xr3 {

enum class Colors : std::uint8_t { kYes, kNo };

/// Whether standard output is a terminal at all.
bool is_terminal();
/// Whether the locale's letters are those of UTF-8.
Letters letters_of_locale();

/// Rows and columns.
struct TerminalSize {
  int rows = 24;
  int columns = 80;
};
/// That of the terminal behind standard output; without one LINES and COLUMNS, or 24 x 80.
TerminalSize terminal_size();

class Terminal {
 public:
  /// Takes the terminal over. Throws std::runtime_error where its type has no way to draw screens.
  Terminal(Letters letters, Colors colors);
  /// Leaves it as it was.
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Shows it; only what differs from the last one is sent.
  void show(const TextScreen& screen);
  /// Tells that the terminal has another size now, and should be painted as a whole.
  void resize();

  /// A key that was pressed, as its letter; nothing where there is none left. Escape is '\x1B'; keys
  /// that are no letters are 0.
  std::optional<char> key();

 private:
  struct Screen;
  Letters letters_;
  std::unique_ptr<Screen> screen_;
};

}  // namespace xr3
