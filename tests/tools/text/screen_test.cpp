#include "tools/text/screen.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

TEST(TextScreen, TruncatesTextWithAnEllipsis) {
  TextScreen screen(2, 6);
  EXPECT_EQ(screen.put(0, 0, "abcdefgh", TextStyle::kPlain, 20), 6);
  EXPECT_EQ(screen.put(1, 2, "abc", TextStyle::kPlain, 2), 4);
  EXPECT_EQ(text_of(screen, Letters::kUnicode), "abcde…\n  a…\n");
}

TEST(TextScreen, IgnoresTextOutsideTheScreen) {
  TextScreen screen(1, 3);
  screen.put(-1, 0, "up", TextStyle::kPlain, 9);
  screen.put(1, 0, "down", TextStyle::kPlain, 9);
  screen.put(0, -1, "xy", TextStyle::kPlain, 9);
  screen.put(0, 7, "far", TextStyle::kPlain, 9);
  screen.put(0, 1, "none", TextStyle::kPlain, -2);
  EXPECT_EQ(text_of(screen, Letters::kUnicode), "y\n");
}

TEST(TextScreen, HasAtLeastOneRowAndColumn) {
  const TextScreen screen(0, -5);
  EXPECT_EQ(screen.rows(), 1);
  EXPECT_EQ(screen.columns(), 1);
  EXPECT_EQ(text_of(screen, Letters::kUnicode), "");
}

TEST(TextScreen, DropsBlankRowsAtTheEndOnly) {
  TextScreen screen(4, 3);
  screen.put(1, 0, "a", TextStyle::kPlain, 3);
  EXPECT_EQ(text_of(screen, Letters::kUnicode), "\na\n");
}

TEST(TextScreen, ReplacesControlCharacters) {
  EXPECT_EQ(one_column_letters("a\x1B[2Jb\r\n\tc\x7F"), U"a?[2Jb???c?");
  EXPECT_EQ(one_column_letters("\xC2\x9B"), U"?") << "the one-byte form of ESC [";
  EXPECT_EQ(one_column_letters("\u202Eabc"), U"?abc") << "writing from right to left";
  EXPECT_EQ(one_column_letters("e\u0301"), U"e?") << "a combining mark";
  EXPECT_EQ(one_column_letters("\u6F22"), U"?") << "a letter of two columns";
  EXPECT_EQ(one_column_letters("Bl\u00F6cke \u2013 \u0416"), U"Bl\u00F6cke \u2013 \u0416");
}

TEST(TextScreen, ReplacesEachInvalidUtf8ByteByOneLetter) {
  EXPECT_EQ(one_column_letters("a\xFF\x80z"), U"a??z");
  EXPECT_EQ(one_column_letters("a\xE2\x96"), U"a??") << "cut short at the end";
  EXPECT_EQ(one_column_letters("\xE2z"), U"?z") << "cut short before a letter";
}

TEST(TextScreen, EveryLetterHasAnAsciiForm) {
  TextScreen screen(1, 9);
  screen.put(0, 0, "█▀▄─│·…×ö", TextStyle::kPlain, 9);
  EXPECT_EQ(text_of(screen, Letters::kAscii), "#\"_-|.~x?\n");
  EXPECT_EQ(text_of(screen, Letters::kUnicode), "█▀▄─│·…×ö\n");
}

}  // namespace
}  // namespace xr3
