// Compiled alone: term.h has macros with names that headers of Boost use.
#include "cli/term/terminal.hpp"

#include <langinfo.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "protocol/text/whole_number.hpp"

#define NCURSES_NOMACROS 1  // macros of ncurses have names such as `move`
#define NCURSES_WIDECHAR 1
#include <curses.h>
#include <term.h>
#undef columns  // a macro of term.h
#undef lines

namespace xr3 {
namespace {

constexpr int kEscapeDelayMs = 25;

struct CursesStyle {
  short color;  ///< -1 for the terminal's default
  attr_t attributes;
};

const std::map<TextStyle, CursesStyle>& looks() {
  static const std::map<TextStyle, CursesStyle> all{{TextStyle::kPlain, {-1, A_NORMAL}},
                                                    {TextStyle::kFaint, {-1, A_DIM}},
                                                    {TextStyle::kStrong, {-1, A_BOLD}},
                                                    {TextStyle::kTitle, {-1, A_REVERSE}},
                                                    {TextStyle::kRule, {COLOR_CYAN, A_NORMAL}},
                                                    {TextStyle::kGood, {COLOR_GREEN, A_NORMAL}},
                                                    {TextStyle::kWarning, {COLOR_YELLOW, A_NORMAL}},
                                                    {TextStyle::kBad, {COLOR_RED, A_BOLD}},
                                                    {TextStyle::kPicture, {COLOR_WHITE, A_BOLD}}};
  return all;
}

short pair_of(TextStyle style) { return static_cast<short>(static_cast<int>(style) + 1); }

void start_colors() {
  if (!has_colors() || start_color() == ERR || use_default_colors() == ERR) return;
  for (const auto& [style, look] : looks()) init_pair(pair_of(style), look.color, -1);
}

[[noreturn]] void refuse_terminal() {
  const char* type = std::getenv("TERM");
  throw std::runtime_error("a terminal of type " + std::string(type ? type : "(TERM is not set)") +
                           " cannot draw screens; xr3 watch --once prints one as text");
}

bool can_move_its_cursor() {
  int trouble = 0;
  if (setupterm(nullptr, STDOUT_FILENO, &trouble) == ERR) return false;
  char name[] = "cup";
  const char* sequence = tigetstr(name);
  // NOLINTNEXTLINE(performance-no-int-to-ptr): terminfo's value for "not a string"
  const bool can = sequence != nullptr && sequence != reinterpret_cast<char*>(-1);
  del_curterm(cur_term);
  return can;
}

/// The variable's value if it is in 1...1000, else `otherwise`.
int environment_size(const char* name, int otherwise) {
  constexpr int kMax = 1000;
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : whole_number(text, 1, kMax).value_or(otherwise);
}

/// The key of a code. Terminfo numbers F1...F12 with Alt from 49 on.
watch::ModeKey key_of(int code) {
  constexpr int kLastByte = 0xFF;  // above, the codes of ncurses begin
  constexpr int kFunctionKeys = 12;
  constexpr int kFirstWithAlt = 49;
  if (code == KEY_BACKSPACE) return {'\b', 0, false};
  if (code == KEY_ENTER) return {'\n', 0, false};
  if (code > KEY_F0 && code <= KEY_F(kFunctionKeys)) return {0, code - KEY_F0, false};
  const int with_alt = code - KEY_F(kFirstWithAlt) + 1;
  if (with_alt >= 1 && with_alt <= kFunctionKeys) return {0, with_alt, true};
  return {code <= kLastByte ? static_cast<char>(code) : '\0', 0, false};
}

}  // namespace

struct Terminal::Screen {
  SCREEN* screen = nullptr;
  bool has_colors = false;
};

bool is_terminal() { return ::isatty(STDOUT_FILENO) != 0; }

Letters letters_of_locale() {
  std::setlocale(LC_CTYPE, "");
  const bool is_utf8 = std::string_view(::nl_langinfo(CODESET)) == "UTF-8";
  return is_utf8 ? Letters::kUnicode : Letters::kAscii;
}

TerminalSize terminal_size() {
  winsize size{};
  const bool is_known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0;
  if (is_known && size.ws_row > 0 && size.ws_col > 0) return {size.ws_row, size.ws_col};
  const TerminalSize usual;
  return {environment_size("LINES", usual.rows), environment_size("COLUMNS", usual.columns)};
}

Terminal::Terminal(Letters letters, Colors colors)
    : letters_(letters), screen_(std::make_unique<Screen>()) {
  if (!can_move_its_cursor()) refuse_terminal();
  screen_->screen = newterm(nullptr, stdout, stdin);
  if (screen_->screen == nullptr) refuse_terminal();
  cbreak();
  noecho();
  nonl();
  keypad(stdscr, TRUE);
  nodelay(stdscr, TRUE);
  set_escdelay(kEscapeDelayMs);
  curs_set(0);
  if (colors == Colors::kYes) start_colors();
  screen_->has_colors = colors == Colors::kYes && has_colors();
}

Terminal::~Terminal() {
  endwin();
  delscreen(screen_->screen);
}

// Consecutive cells of the same style are sent together.
void Terminal::show(const TextScreen& screen) {
  erase();
  for (int row = 0; row < screen.rows(); ++row) {
    for (int column = 0; column < screen.columns();) {
      const TextStyle style = screen.at(row, column).style;
      const int from = column;
      std::wstring letters;
      for (; column < screen.columns() && screen.at(row, column).style == style; ++column) {
        letters += static_cast<wchar_t>(in_letters(screen.at(row, column).letter, letters_));
      }
      const attr_t attributes = looks().at(style).attributes;
      attr_set(attributes, screen_->has_colors ? pair_of(style) : short{0}, nullptr);
      mvaddnwstr(row, from, letters.c_str(), static_cast<int>(letters.size()));
    }
  }
  refresh();
}

void Terminal::resize() {
  const TerminalSize size = terminal_size();
  resizeterm(size.rows, size.columns);
  clearok(stdscr, TRUE);
}

std::optional<watch::ModeKey> Terminal::key() {
  constexpr int kEscape = 0x1B;
  const int code = getch();
  if (code == ERR) return {};
  const int after = code == kEscape ? getch() : ERR;
  watch::ModeKey key = key_of(after == ERR ? code : after);
  key.is_alt = key.is_alt || after != ERR;
  return key;
}

}  // namespace xr3
