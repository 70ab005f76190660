#include "cell/serial_line.hpp"

#include <gtest/gtest.h>

#include "tests/support/models.hpp"

namespace xr3 {
namespace {

struct OneLine {
  Simulation simulation{test::rhino()};
  SerialLine line{Profile::kPaper, LineKind::kTcp, "test", 0};
  std::vector<Exchange> exchanges;

  std::size_t receive(std::string_view bytes) { return line.receive(bytes, simulation, exchanges); }
};

TEST(SerialLine, AFullOutboxStopsInputUntilItIsEmpty) {
  OneLine one;
  one.receive("E?");
  const std::string flood(2 * SerialLine::kFullOutbox, '?');
  const std::size_t taken = one.receive(flood);
  EXPECT_EQ(taken, SerialLine::kFullOutbox - 1);
  EXPECT_TRUE(one.line.is_full());
  EXPECT_EQ(one.receive("?"), 0U);
  one.line.sent(10);
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
    one.line.sent(piece.size());
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
  one.line.sent(4);
  EXPECT_EQ(one.line.bytes_out(), 4U);
}

TEST(SerialLine, HeldBytesKeepTheirOffsets) {
  OneLine one;
  one.receive("P");
  EXPECT_TRUE(one.exchanges.empty());
  one.receive("3");
  ASSERT_EQ(one.exchanges.size(), 1U);
  EXPECT_EQ(one.exchanges[0].parsed.from, 0U);
  EXPECT_EQ(one.exchanges[0].parsed.to, 2U);
  EXPECT_EQ(one.simulation.state().io.outputs, 4);
}

TEST(SerialLine, NoByteOfAnotherProtocolTakesEffect) {
  OneLine one;
  const std::string request = "DELETE / HTTP/1.1\r\n\r\nF+100\r";
  EXPECT_EQ(one.receive(request), 8U);
  EXPECT_TRUE(one.line.is_not_a_robot_program());
  EXPECT_EQ(one.receive("F+100\r"), 0U);
  EXPECT_EQ(one.simulation.state(), initial_state(one.simulation.model()));
}

TEST(SerialLine, TakesNoByteOfARefusedChunk) {
  OneLine one;
  const std::string request = "E+50 / HTTP/1.1\r\n\r\n";
  one.line.examine(request);
  EXPECT_TRUE(one.line.is_not_a_robot_program());
  EXPECT_EQ(one.receive(request), 0U);
  EXPECT_EQ(one.simulation.state(), initial_state(one.simulation.model()));
}

TEST(SerialLine, WithoutAGuardEveryByteActsAtOnce) {
  OneLine one;
  one.line = SerialLine(Profile::kPaper, LineKind::kTcp, "test", 0, Guard::kOff);
  one.receive("P");
  one.receive("O");
  EXPECT_EQ(one.line.bytes_in(), 2U);
  one.receive("GET / HTTP/1.1\rE+5\rE?");
  EXPECT_FALSE(one.line.is_not_a_robot_program());
  EXPECT_TRUE(one.line.outbox().ends_with('%'));
}

}  // namespace
}  // namespace xr3
