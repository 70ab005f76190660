#include "cli/term/raw_terminal.hpp"

#include <stdexcept>

namespace xr3 {

RawTerminal::RawTerminal() {
  if (::tcgetattr(STDIN_FILENO, &before_) != 0) {
    throw std::runtime_error("standard input is no terminal");
  }
  enter();
}

// Output is still processed: \n begins a new line.
void RawTerminal::enter() {
  ::termios raw = before_;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | ISIG | IEXTEN);
  raw.c_iflag &= ~static_cast<tcflag_t>(ICRNL | INLCR | IGNCR | IXON | ISTRIP | BRKINT | PARMRK);
  raw.c_cc[VMIN] = 1;
  raw.c_cc[VTIME] = 0;
  ::tcsetattr(STDIN_FILENO, TCSANOW, &raw);
}

}  // namespace xr3
