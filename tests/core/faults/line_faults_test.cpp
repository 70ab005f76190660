// What faults of a line make of its bytes.
#include "core/faults/line_faults.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <functional>

#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::Rig;

Fault on_line(FaultKind kind, const std::function<void(Fault&)>& change) {
  Fault fault;
  fault.name = "noise";
  fault.kind = kind;
  change(fault);
  return fault;
}

Rig rig_of_lines(Fault fault) {
  Rig rig;
  rig.simulation.install_faults({7, {std::move(fault)}});
  return rig;
}

/// What arrives of a client's bytes on a line.
std::string received(Rig& rig, std::string_view bytes, std::uint32_t line = 1) {
  std::string all;
  for (std::uint64_t i = 0; i < bytes.size(); ++i) {
    const auto byte = static_cast<std::uint8_t>(bytes[i]);
    all += rig.simulation.carry_input({line, LineSide::kIn, i}, byte).bytes;
  }
  return all;
}

std::string replied(Rig& rig, std::string_view reply, std::uint64_t offset = 0) {
  return rig.simulation.carry_reply({1, LineSide::kOut, offset}, reply).bytes;
}

struct ByteCase {
  FaultKind kind;
  std::string received;
};

TEST(LineFaults, ActOnTheByteAfterSoMany) {
  const ByteCase cases[] = {{FaultKind::kByteDropped, "E5?"},
                            {FaultKind::kByteDoubled, "E++5?"},
                            {FaultKind::kByteFlipped, "E*5?"},
                            {FaultKind::kParityError, "E5?"},
                            {FaultKind::kReplyLost, "E+5?"}};
  for (const ByteCase& each : cases) {
    Rig rig = rig_of_lines(on_line(each.kind, [](Fault& f) {
      f.after_bytes = 1;
      f.bit = 0;
    }));
    EXPECT_EQ(received(rig, "E+5?"), each.received);
  }
}

TEST(LineFaults, ActOnTheirLineAndDirectionOnly) {
  Rig rig = rig_of_lines(on_line(FaultKind::kByteDropped, [](Fault& f) {
    f.from_tick = 0;
    f.line = 2;
  }));
  EXPECT_EQ(received(rig, "E?", 1), "E?");
  EXPECT_EQ(received(rig, "E?", 2), "");
  EXPECT_EQ(rig.simulation.carry_reply({2, LineSide::kOut, 0}, " ").bytes, " ");
}

TEST(LineFaults, AFlippedBitIsAnyOfSeven) {
  Rig rig = rig_of_lines(on_line(FaultKind::kByteFlipped, [](Fault& f) { f.from_tick = 0; }));
  unsigned flipped = 0;
  for (const char c : received(rig, std::string(100, '\0'))) {
    EXPECT_EQ(std::popcount(static_cast<unsigned char>(c)), 1);
    flipped |= static_cast<unsigned char>(c);
  }
  EXPECT_EQ(flipped, 0x7FU);
}

TEST(LineFaults, AWrongBaudRateGarblesEveryByte) {
  Rig rig = rig_of_lines(on_line(FaultKind::kWrongBaud, [](Fault& f) { f.from_tick = 0; }));
  const std::string sent(200, 'E');
  const std::string arrived = received(rig, sent);
  ASSERT_EQ(arrived.size(), sent.size());
  EXPECT_EQ(arrived.find('E'), std::string::npos);
  EXPECT_NE(arrived.substr(0, 100), arrived.substr(100));
}

TEST(LineFaults, AWrongParityShowsTheParityBit) {
  Rig rig = rig_of_lines(on_line(FaultKind::kWrongParity, [](Fault& f) { f.from_tick = 0; }));
  EXPECT_EQ(received(rig, "E?C"), "\xC5?\xC3") << "E and C have three ones, ? has six";
}

TEST(LineFaults, AParityErrorDropsInputAndMakesARepliedByte0) {
  Rig rig = rig_of_lines(on_line(FaultKind::kParityError, [](Fault& f) {
    f.from_tick = 0;
    f.direction = LineSide::kOut;
  }));
  const Carried carried = rig.simulation.carry_reply({1, LineSide::kOut, 0}, "%");
  EXPECT_EQ(carried.bytes, std::string(1, '\0'));
  EXPECT_TRUE(carried.has_parity_error);
}

TEST(LineFaults, AReplyIsLostAsAWhole) {
  Rig rig = rig_of_lines(on_line(FaultKind::kReplyLost, [](Fault& f) { f.after_bytes = 3; }));
  EXPECT_EQ(replied(rig, "abc", 0), "abc");
  EXPECT_EQ(replied(rig, "def", 3), "");
  EXPECT_EQ(replied(rig, "ghi", 6), "ghi");
}

TEST(LineFaults, ChanceDependsOnLineAndOffset) {
  const auto lost_on = [](std::uint32_t line) {
    Rig rig =
        rig_of_lines(on_line(FaultKind::kByteDropped, [](Fault& f) { f.chance = 300'000'000; }));
    return received(rig, "abcdefghijklmnopqrstuvwxyz", line);
  };
  EXPECT_EQ(lost_on(1), lost_on(1));
  EXPECT_NE(lost_on(1), lost_on(2));
  EXPECT_LT(lost_on(1).size(), 26U);
}

TEST(LineFaults, RepliesAreDelayedHeldAndBatched) {
  Rig rig = rig_of_lines(on_line(FaultKind::kReplyDelayed, [](Fault& f) {
    f.from_tick = 0;
    f.delay_ms = 40;
  }));
  EXPECT_EQ(rig.simulation.carry_reply({1, LineSide::kOut, 0}, "x").delay_ms, 40U);
  rig = rig_of_lines(on_line(FaultKind::kReplyBatched, [](Fault& f) { f.from_tick = 10; }));
  EXPECT_EQ(batch_tick(rig.state(), 1, rig.simulation.tick()), 0);
  rig.pass(33);
  EXPECT_EQ(batch_tick(rig.state(), 1, rig.simulation.tick()), 48);
  rig.pass(15);
  EXPECT_EQ(batch_tick(rig.state(), 1, rig.simulation.tick()), 48);
  rig = rig_of_lines(on_line(FaultKind::kXoffStall, [](Fault& f) {
    f.from_tick = 10;
    f.ticks = 10;
  }));
  EXPECT_EQ(xoff_end(rig.state(), 1), 0);
  rig.pass(19);
  EXPECT_EQ(xoff_end(rig.state(), 1), 20);
  rig.pass(1);
  EXPECT_EQ(xoff_end(rig.state(), 1), 20) << "now";
}

TEST(LineFaults, ALineIsDisconnectedAfterAByteOrAtATick) {
  Rig rig =
      rig_of_lines(on_line(FaultKind::kLineDisconnected, [](Fault& f) { f.after_bytes = 2; }));
  EXPECT_FALSE(rig.simulation.carry_input({1, LineSide::kIn, 1}, '?').is_disconnected);
  EXPECT_TRUE(rig.simulation.carry_input({1, LineSide::kIn, 2}, '?').is_disconnected);
  EXPECT_FALSE(rig.simulation.carry_input({1, LineSide::kIn, 3}, '?').is_disconnected);
  rig = rig_of_lines(on_line(FaultKind::kLineDisconnected, [](Fault& f) {
    f.at_tick = 50;
    f.line = 3;
  }));
  rig.pass(100);
  EXPECT_EQ(rig.events_of<FaultNews>().front().line, 3U);
  EXPECT_EQ(test::ticks_of<FaultNews>(rig.simulation.events()), (std::vector<Tick>{50}));
  EXPECT_FALSE(rig.simulation.carry_input({3, LineSide::kIn, 0}, '?').is_disconnected);
}

TEST(LineFaults, StrayBytesComeAtTheOpening) {
  Rig rig = rig_of_lines(on_line(FaultKind::kStrayByte, [](Fault& f) {
    f.from_tick = 0;
    f.byte = 'X';
    f.count = 2;
  }));
  EXPECT_EQ(rig.simulation.stray_bytes({1, LineSide::kOut, 0}), "");
  EXPECT_EQ(rig.simulation.stray_bytes({1, LineSide::kIn, 0}), "X");
  EXPECT_EQ(rig.simulation.stray_bytes({2, LineSide::kIn, 0}), "X");
  EXPECT_EQ(rig.simulation.stray_bytes({3, LineSide::kIn, 0}), "");
}

}  // namespace
}  // namespace xr3
