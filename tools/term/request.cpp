#include "tools/term/request.hpp"

namespace xr3::term {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

}  // namespace

std::optional<UserRequest> escape_of(std::string_view text) {
  if (text.empty()) return std::nullopt;
  if (text[0] == 's' && (text.size() == 1 || text[1] == ' ')) {
    const std::string_view path = trimmed(text.substr(1));
    if (path.empty()) return ShowHint{"~s needs the name of a file, as in ~s program.txt"};
    return SendFile{std::string(path)};
  }
  const std::string_view rest = trimmed(text.substr(1));
  if (!rest.empty()) return std::nullopt;
  switch (text[0]) {
    case '.': return Quit{};
    case 'b': return SendBreak{};
    case '?': return ShowHelp{};
    case kEscapeKey: return SendBytes{std::string(1, kEscapeKey)};
    default: return std::nullopt;
  }
}

// The request of a line. Two ~ at its start send one, whatever follows.
UserRequest request_of_line(std::string_view line) {
  if (line.starts_with("~~")) return SendBytes{std::string(line.substr(1)) + "\r"};
  if (line.starts_with(kEscapeKey)) {
    if (auto escape = escape_of(line.substr(1))) return *escape;
  }
  return SendBytes{std::string(line) + "\r"};
}

std::string_view help_text() {
  return "at the start of a line:\n"
         "  ~.       quit (so does Ctrl-C)\n"
         "  ~s FILE  send a file\n"
         "  ~b       send a break\n"
         "  ~~       send ~\n"
         "  ~?       this help\n"
         "E? asks how far joint E has still to go; E+50 and Enter moves it.\n";
}

}  // namespace xr3::term
