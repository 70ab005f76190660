#include "cell/line/serial_line.hpp"

#include <gtest/gtest.h>

#include "tests/support/models.hpp"
#include "tests/support/one_line.hpp"

namespace xr3 {
namespace {

struct OneLine : test::OneLine {
  explicit OneLine(LineKind kind = LineKind::kTcp, Guard guard = Guard::kNormal)
      : test::OneLine(test::rhino(), kind, guard) {}
};

TEST(SerialLine, AFullOutboxStopsInputUntilItIsEmpty) {
  OneLine one;
  one.receive("E?");
  const std::string flood(2 * SerialLine::kFullOutbox, '?');
  const std::size_t taken = one.receive(flood);
  EXPECT_EQ(taken, SerialLine::kFullOutbox - 1);
  EXPECT_TRUE(one.line.is_full());
  EXPECT_EQ(one.receive("?"), 0U);
  one.line.sent(10, 0);
  EXPECT_EQ(one.receive("?"), 1U);
}

TEST(SerialLine, AnOutboxSentInPiecesLosesNothing) {
  OneLine one;
  std::string expected;
  std::string sent;
  for (int counts = 1; counts < 120; ++counts) {
    one.receive("E+1\rE?");
    expected += static_cast<char>(32 + counts);
    EXPECT_EQ(one.line.output_end(), expected.size());
    const std::string piece(one.line.outbox().substr(0, static_cast<std::size_t>(counts % 4)));
    sent += piece;
    one.line.sent(piece.size(), 0);
    EXPECT_EQ(one.line.bytes_out(), sent.size());
  }
  EXPECT_EQ(sent + std::string(one.line.outbox()), expected);
}

TEST(SerialLine, CountsTransportBytes) {
  OneLine one;
  one.receive(
      "E+5\r\xff\xfd\x06"
      "E?");
  EXPECT_EQ(one.line.bytes_in(), 9U);
  EXPECT_EQ(one.line.outbox(), "\xff\xfb\x06%");
  one.line.sent(4, 0);
  EXPECT_EQ(one.line.bytes_out(), 4U);
}

TEST(SerialLine, HeldBytesKeepTheirOffsets) {
  OneLine one;
  one.receive("P");
  EXPECT_TRUE(one.exchanges().empty());
  one.receive("3");
  ASSERT_EQ(one.exchanges().size(), 1U);
  EXPECT_EQ(one.exchanges()[0].parsed.from, 0U);
  EXPECT_EQ(one.exchanges()[0].parsed.to, 2U);
  EXPECT_EQ(one.cell.machine.state().io.outputs, 4);
}

TEST(SerialLine, NoByteOfAnotherProtocolTakesEffect) {
  OneLine one;
  const std::string request = "DELETE / HTTP/1.1\r\n\r\nF+100\r";
  EXPECT_EQ(one.receive(request), 8U);
  EXPECT_TRUE(one.line.is_not_a_robot_program());
  EXPECT_EQ(one.receive("F+100\r"), 0U);
  EXPECT_EQ(one.cell.machine.state(), initial_state(one.cell.machine.model()));
}

TEST(SerialLine, TakesNoByteOfARefusedChunk) {
  OneLine one;
  const std::string request = "E+50 / HTTP/1.1\r\n\r\n";
  one.line.examine(request);
  EXPECT_TRUE(one.line.is_not_a_robot_program());
  EXPECT_EQ(one.receive(request), 0U);
  EXPECT_EQ(one.cell.machine.state(), initial_state(one.cell.machine.model()));
}

TEST(SerialLine, WithoutAGuardEveryByteActsAtOnce) {
  OneLine one(LineKind::kTcp, Guard::kOff);
  one.receive("P");
  one.receive("O");
  EXPECT_EQ(one.line.bytes_in(), 2U);
  one.receive("GET / HTTP/1.1\rE+5\rE?");
  EXPECT_FALSE(one.line.is_not_a_robot_program());
  EXPECT_TRUE(one.line.outbox().ends_with('%'));
}

// --- Replies that an RFC 2217 client has suspended.

const std::string kComPort = "\xff\xfb\x2c";
const std::string kSuspend = "\xff\xfa\x2c\x08\xff\xf0";
const std::string kResume = "\xff\xfa\x2c\x09\xff\xf0";
const std::string kPurgeReplies = "\xff\xfa\x2c\x0c\x01\xff\xf0";
const std::string kPurgedReplies = "\xff\xfa\x2c\x70\x01\xff\xf0";
const std::string kAskModemState = "\xff\xfa\x2c\x07\xff\xf0";
const std::string kModemState = "\xff\xfa\x2c\x6b\xb0\xff\xf0";

struct SuspendedLine : OneLine {
  SuspendedLine() {
    receive("\r" + kComPort + kSuspend);
    fetch();
  }
};

TEST(SuspendedReplies, WaitForTheResume) {
  SuspendedLine one;
  one.receive("E+5\rE?");
  one.receive("F-1\rFT");
  EXPECT_EQ(one.fetch(), "");
  EXPECT_EQ(one.line.held_bytes(), 2U);
  one.receive(kResume + "D?");
  EXPECT_EQ(one.fetch(), "%\xff\xff ") << "in order, FF doubled";
  EXPECT_EQ(one.line.held_bytes(), 0U);
  one.receive("D?");
  EXPECT_EQ(one.fetch(), " ");
}

TEST(SuspendedReplies, DoNotDelayAnswersOfTelnet) {
  SuspendedLine one;
  one.receive("E?" + kAskModemState);
  EXPECT_EQ(one.fetch(), kModemState);
  EXPECT_EQ(one.line.held_bytes(), 1U);
}

TEST(SuspendedReplies, ArePurgedByTheClient) {
  SuspendedLine one;
  one.receive("E?" + kPurgeReplies + "F?");
  EXPECT_EQ(one.fetch(), kPurgedReplies);
  one.receive(kResume);
  EXPECT_EQ(one.fetch(), " ") << "the line stays suspended after the purge";
}

TEST(SuspendedReplies, ReadingGoesOnUntilTheHoldIsFull) {
  SuspendedLine one;
  const std::string flood(2 * ReplyHold::kFull, 'I');
  EXPECT_EQ(one.receive(flood), ReplyHold::kFull);
  EXPECT_EQ(one.receive("I"), 0U);
  EXPECT_EQ(one.receive(kAskModemState + "I"), kAskModemState.size()) << "commands are read";
  EXPECT_EQ(one.fetch(), kModemState);
  EXPECT_EQ(one.receive(kResume), kResume.size());
  EXPECT_EQ(one.fetch(), std::string(ReplyHold::kFull, ' '));
  EXPECT_EQ(one.receive("I"), 1U);
}

TEST(SuspendedReplies, LeaveAtTheEndOfTheInput) {
  SuspendedLine one;
  one.receive("E?");
  one.end_input();
  EXPECT_EQ(one.fetch(), " ");
  one.receive(kSuspend + "E?");
  EXPECT_EQ(one.fetch(), " ") << "nobody can resume them";
}

TEST(SuspendedReplies, LeaveWhenTheClientEndsTheOption) {
  SuspendedLine one;
  one.receive("E?\xff\xfc\x2c");
  EXPECT_EQ(one.fetch(), "\xff\xfe\x2c ");
}

TEST(SuspendedReplies, AreReportedWhereTheyLeave) {
  SuspendedLine one;
  const std::uint64_t before = one.line.output_end();
  one.receive("F-1\rFTE?");
  one.receive(kAskModemState + kResume + "D?");
  ASSERT_EQ(one.out.talk.replies.size(), 3U);
  const std::uint64_t from = before + kModemState.size();
  EXPECT_EQ(one.out.talk.replies[0].from, from);
  EXPECT_EQ(one.out.talk.replies[0].to, from + 2) << "FF is sent twice";
  EXPECT_EQ(one.out.talk.replies[1].to, from + 3);
  EXPECT_EQ(one.out.talk.replies[2].from, from + 3);
}

TEST(SerialLine, ShowsTheProtocolOfItsClient) {
  OneLine one;
  EXPECT_EQ(one.line.kind(), LineKind::kTcp);
  EXPECT_EQ(one.line.settings(), std::nullopt);
  one.receive("\r\xff\xfd\x01");
  EXPECT_EQ(one.line.kind(), LineKind::kTelnet);
  one.receive(kComPort);
  EXPECT_EQ(one.line.kind(), LineKind::kRfc2217);
  EXPECT_EQ(text_of(one.line.settings().value()), "9600-7e2");
  one.receive("\xff\xfa\x2c\x02\x08\xff\xf0");
  EXPECT_EQ(text_of(one.line.settings().value()), "9600-8e2");
  one.receive("\xff\xfc\x2c");
  EXPECT_EQ(one.line.kind(), LineKind::kTelnet);
}

TEST(SerialLine, APseudoTerminalHasNoTelnet) {
  OneLine one(LineKind::kPty);
  one.receive("\xff\xfd\x03PUT / E?");
  EXPECT_EQ(one.line.outbox(), " ");
  EXPECT_EQ(one.line.kind(), LineKind::kPty);
  EXPECT_FALSE(one.line.set_settings({1200, std::nullopt}, false));
  EXPECT_EQ(text_of(one.line.settings().value()), "1200");
  EXPECT_TRUE(one.line.set_settings({1200, std::nullopt}, true)) << "it echoes now";
  EXPECT_FALSE(one.line.set_settings({1200, std::nullopt}, false));
  EXPECT_FALSE(one.line.set_settings({1200, std::nullopt}, true)) << "which is reported once";
}

}  // namespace
}  // namespace xr3
