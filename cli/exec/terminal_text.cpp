#include "cli/exec/terminal_text.hpp"

#include "protocol/text/printable.hpp"

namespace xr3 {
namespace {

/// The number of bytes at the end that begin a character in UTF-8 and do not complete it.
std::size_t unfinished(std::string_view text) {
  constexpr std::size_t kMostBytes = 4;
  for (std::size_t count = 1; count < kMostBytes && count <= text.size(); ++count) {
    const auto byte = static_cast<unsigned char>(text[text.size() - count]);
    if (byte < 0x80) return 0;
    if (byte < 0xC0) continue;
    const std::size_t length = byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : 2;
    return count < length ? count : 0;
  }
  return 0;
}

}  // namespace

std::string TerminalText::add(std::string_view text) {
  std::string all = rest_.append(text);
  rest_ = all.substr(all.size() - unfinished(all));
  all.resize(all.size() - rest_.size());
  return printable_lines(all);
}

}  // namespace xr3
