// The terminal on standard input without line editing and echo, so that each key arrives at once.
#pragma once

#include <termios.h>
#include <unistd.h>

namespace xr3 {

/// Restores the terminal's settings when it is destroyed.
class RawTerminal {
 public:
  /// Throws std::runtime_error if standard input is no terminal.
  RawTerminal();
  ~RawTerminal() { ::tcsetattr(STDIN_FILENO, TCSANOW, &before_); }
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  /// Sets the terminal up again, after another program has used it.
  void enter();

 private:
  ::termios before_{};
};

}  // namespace xr3
