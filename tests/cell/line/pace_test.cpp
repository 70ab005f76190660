#include "cell/line/pace.hpp"

#include <gtest/gtest.h>

#include <string>

namespace xr3 {
namespace {

using enum Direction;

/// 1 ms a character.
LinePace pace_of_1_ms() {
  return LinePace(CharacterTime(*parse_serial_settings("10000-8n1"), Rate{}));
}

wire::Meaning answered() { return wire::Answered{QueryError{'E'}, NoReply{}}; }

TEST(LinePace, DirectionsAreIndependent) {
  LinePace pace = pace_of_1_ms();
  EXPECT_FALSE(pace.due(kIn) || pace.due(kOut));
  pace.add_input({'E', 0}, 100);
  pace.add_input({'?', 1}, 500);
  pace.add_reply("%", answered(), 700);
  EXPECT_EQ(pace.due(kIn), 1'100);
  EXPECT_EQ(pace.due(kOut), 1'700);
  EXPECT_EQ(pace.take_input().byte, 'E');
  EXPECT_EQ(pace.due(kIn), 2'100);
  EXPECT_EQ(pace.take_input().offset, 1U);
  EXPECT_EQ(pace.due(kIn), std::nullopt);
  EXPECT_EQ(pace.take_reply_byte().byte, '%');
  EXPECT_TRUE(pace.is_empty());
}

TEST(LinePace, TheLastByteOfAReplyHasItsMeaning) {
  LinePace pace = pace_of_1_ms();
  pace.add_reply("abc", answered(), 0);
  pace.add_reply("d", wire::MoreAnswers{1}, 0);
  std::string shape;
  while (!pace.is_empty()) {
    const ReplyByte next = pace.take_reply_byte();
    shape += next.is_first ? "(" : "";
    shape += next.byte;
    shape += next.meaning ? ")" : "";
  }
  EXPECT_EQ(shape, "(abc)(d)");
}

TEST(LinePace, MeaningsTakeBoundedMemory) {
  LinePace pace = pace_of_1_ms();
  constexpr std::uint32_t kExtra = 1000;
  for (std::size_t i = 0; i < ReplyHold::kMaxItems + kExtra; ++i)
    pace.add_reply("x", answered(), 0);
  std::size_t meanings = 0;
  std::uint32_t more = 0;
  while (!pace.is_empty()) {
    const ReplyByte next = pace.take_reply_byte();
    meanings += next.meaning ? 1U : 0U;
    if (next.meaning && std::holds_alternative<wire::MoreAnswers>(*next.meaning))
      more = std::get<wire::MoreAnswers>(*next.meaning).count;
  }
  EXPECT_EQ(meanings, ReplyHold::kMaxItems + 1);
  EXPECT_EQ(more, kExtra);
}

TEST(LinePace, IsFull) {
  LinePace pace = pace_of_1_ms();
  for (std::size_t i = 0; i < LinePace::kMaxInput; ++i) {
    EXPECT_TRUE(pace.accepts_input());
    pace.add_input({'E', i}, 0);
  }
  EXPECT_FALSE(pace.accepts_input());
  EXPECT_FALSE(pace.are_replies_full());
  pace.add_reply(std::string(ReplyHold::kFull, 'x'), answered(), 0);
  EXPECT_TRUE(pace.are_replies_full());
  pace.discard_input();
  pace.discard_replies();
  EXPECT_TRUE(pace.is_empty());
  EXPECT_FALSE(pace.due(kIn) || pace.due(kOut));
}

TEST(LinePace, AfterAHaltTheByteTakesItsWholeTime) {
  LinePace pace = pace_of_1_ms();
  pace.add_reply("ab", answered(), 0);
  pace.halt(kOut, true, 0);
  EXPECT_EQ(pace.due(kOut), std::nullopt);
  pace.add_reply("c", answered(), 100);
  EXPECT_EQ(pace.due(kOut), std::nullopt);
  pace.halt(kOut, false, 5'000);
  EXPECT_EQ(pace.due(kOut), 6'000);
  pace.halt(kOut, false, 5'500);
  EXPECT_EQ(pace.due(kOut), 6'000) << "it was not halted";
}

TEST(LinePace, StartsAgainAfterAJumpOfTime) {
  LinePace pace = pace_of_1_ms();
  pace.add_input({'E', 0}, 50'000);
  pace.restart(0);
  EXPECT_EQ(pace.due(kIn), 1'000);
  EXPECT_EQ(pace.due(kOut), std::nullopt);
}

}  // namespace
}  // namespace xr3
