// Keys from the bytes of a terminal.
#include "tools/term/keystroke.hpp"

#include <gtest/gtest.h>

#include <string>

namespace xr3::term {
namespace {

/// Keys as letters: a byte as itself, the others as a name in <>.
std::string names(const std::vector<Keystroke>& keys) {
  static const char* const kNames[] = {"byte",  "enter", "backspace", "delete", "left",
                                       "right", "up",    "down",      "home",   "end",
                                       "^C",    "^D",    "other"};
  std::string all;
  for (const Keystroke& key : keys) {
    const bool is_byte = key.code == KeyCode::kByte;
    all += is_byte ? std::string(1, key.byte)
                   : "<" + std::string(kNames[static_cast<int>(key.code)]) + ">";
  }
  return all;
}

std::string names_of(std::string_view bytes) { return names(KeyReader().feed(bytes)); }

TEST(KeyReader, PlainAndControlKeys) {
  EXPECT_EQ(names_of("E+5 ~"), "E+5 ~");
  EXPECT_EQ(names_of("E\r?\n"), "E<enter>?<enter>");
  EXPECT_EQ(names_of("\x7f\b\x03\x04"), "<backspace><backspace><^C><^D>");
  EXPECT_EQ(names_of("\x01\xc3\xa4"), "\x01\xc3\xa4");
}

TEST(KeyReader, KeysThatAreSequences) {
  EXPECT_EQ(names_of("\x1b[A\x1b[B\x1b[C\x1b[D"), "<up><down><right><left>");
  EXPECT_EQ(names_of("\x1bOA\x1bOH\x1bOF"), "<up><home><end>");
  EXPECT_EQ(names_of("\x1b[H\x1b[F\x1b[1~\x1b[4~\x1b[3~"), "<home><end><home><end><delete>");
  EXPECT_EQ(names_of("\x1b[1;5A"), "<up>") << "with Ctrl";
  EXPECT_EQ(names_of("a\x1b[15~b"), "a<other>b") << "F5";
  EXPECT_EQ(names_of("a\x1b[[Ab"), "a<other>b") << "F1 of Linux is not the cursor key";
  EXPECT_EQ(names_of("\x1b"
                     "E5"),
            "<other>5")
      << "Alt-E selects no joint";
}

TEST(KeyReader, SequencesMayBeSplit) {
  KeyReader keys;
  EXPECT_EQ(names(keys.feed("E\x1b")), "E");
  EXPECT_EQ(names(keys.feed("[")), "");
  EXPECT_EQ(names(keys.feed("A?")), "<up>?");
}

TEST(KeyReader, LongNumbersDoNotOverflow) {
  EXPECT_EQ(names_of("\x1b[99999999999999999999~x"), "<other>x");
}

}  // namespace
}  // namespace xr3::term
