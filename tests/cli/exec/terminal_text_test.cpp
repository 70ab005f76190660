#include "cli/exec/terminal_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace xr3 {
namespace {

std::string shown(std::string_view text, std::size_t piece) {
  TerminalText terminal;
  std::string all;
  for (; !text.empty(); text.remove_prefix(std::min(piece, text.size())))
    all += terminal.add(text.substr(0, piece));
  return all;
}

TEST(TerminalText, KeepsLinesAndTabs) {
  EXPECT_EQ(shown("one\ttwo\n\x1b]0;x\x07\n", 100), "one\ttwo\n\\x1b]0;x\\x07\n");
}

TEST(TerminalText, PiecesAreShownAsTheWhole) {
  const std::string_view text = "\xE2\x9C\x93 gr\xC3\xBC\xC3\x9F \xF0\x9F\xA4\x96\n\x1b[0m.";
  for (const std::size_t piece : {1U, 2U, 3U, 100U})
    EXPECT_EQ(shown(text, piece), "\xE2\x9C\x93 gr\xC3\xBC\xC3\x9F \xF0\x9F\xA4\x96\n\\x1b[0m.");
}

}  // namespace
}  // namespace xr3
