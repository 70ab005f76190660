// Browsers and TLS clients on the robot port: detected by their first bytes, before any byte is
// executed.
#include "protocol/stranger_guard.hpp"

#include <gtest/gtest.h>

#include "core/simulation.hpp"
#include "protocol/diagnostic.hpp"
#include "tests/support/models.hpp"
#include "tests/support/wire.hpp"
#include "tests/support/words.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;
using test::Wire;

constexpr std::string_view kGreetings[] = {"GET /",     "HEAD /",   "POST /",  "PUT /",
                                           "PATCH /",   "DELETE /", "TRACE /", "OPTIONS /",
                                           "CONNECT /", "\x16\x03"};

TEST(StrangerGuard, AGreetingIsHeldUntilItsLastByteGivesItAway) {
  for (const std::string_view greeting : kGreetings) {
    StrangerGuard guard;
    for (std::size_t i = 0; i + 1 < greeting.size(); ++i) {
      EXPECT_EQ(guard.take(static_cast<std::uint8_t>(greeting[i])), Verdict::kHold) << greeting;
      EXPECT_EQ(guard.held(), greeting.substr(0, i + 1));
    }
    EXPECT_LE(guard.held().size(), StrangerGuard::kMostHeld);
    EXPECT_EQ(guard.take(static_cast<std::uint8_t>(greeting.back())), Verdict::kStranger)
        << greeting;
    for (const char later : "E+5\r"sv) {
      EXPECT_EQ(guard.take(static_cast<std::uint8_t>(later)), Verdict::kStranger);
    }
  }
}

TEST(StrangerGuard, AWholeRequestLeavesTheMachineAsItWas) {
  for (const std::string_view greeting : kGreetings) {
    Simulation simulation(test::rhino());
    const State before = simulation.state();
    Wire wire(Profile::kPaper);
    wire.send(std::string(greeting) + "E+5\r HTTP/1.1\r\nHost: localhost\r\n\r\nE+100\rP1LNO\r",
              simulation);
    EXPECT_TRUE(wire.is_closed()) << greeting;
    EXPECT_EQ(simulation.state(), before) << greeting;
    EXPECT_EQ(wire.received(), "") << greeting;
    EXPECT_TRUE(wire.exchanges().empty()) << greeting;
  }
}

std::string without_guard(std::string_view bytes) {
  Simulation simulation(test::rhino());
  RhinoEndpoint endpoint(Profile::kPaper);
  std::string replies;
  std::vector<Exchange> exchanges;
  for (const char byte : bytes) {
    simulation.take_events();
    endpoint.take(static_cast<std::uint8_t>(byte), 0, simulation, replies, exchanges);
  }
  return replies;
}

// Each opening, cut after each of its bytes and followed by something else, is passed on unchanged.
TEST(StrangerGuard, TheFirstByteThatDiffersLetsThemAllAct) {
  for (const std::string_view greeting : kGreetings) {
    for (std::size_t cut = 0; cut < greeting.size(); ++cut) {
      for (const std::string_view rest : {"?"sv, "X?"sv, "\rE+5?"sv, "1\rI"sv, "\x16?"sv}) {
        const std::string bytes = std::string(greeting.substr(0, cut)) + std::string(rest);
        if (bytes.substr(0, greeting.size()) == greeting) continue;
        Simulation simulation(test::rhino());
        Wire wire(Profile::kPaper);
        wire.send(bytes, simulation);
        EXPECT_FALSE(wire.is_closed()) << readable(bytes);
        EXPECT_EQ(hexadecimal(wire.received()), hexadecimal(without_guard(bytes)))
            << readable(bytes);
      }
    }
  }
}

struct PassRow {
  std::string_view bytes;
  std::size_t held;  ///< of them, before one differs
};

TEST(StrangerGuard, WhatIsNoGreeting) {
  constexpr PassRow kRows[] = {
      {"E", 0},          {"get /", 0},    {"D?", 1},       {"C+5", 1},       {"P3", 1},
      {"PX", 1},         {"PO3", 2},      {"G?", 1},       {"GET\r", 3},     {"GET  /", 4},
      {"GET x", 4},      {"OO", 1},       {"DELETE?", 6},  {"POST\r\n/", 4}, {"HEAD\t/", 4},
      {"\r\nGET /", 0},  {" GET /", 0},   {"\x16\x02", 1}, {"\x16\r", 1},    {"I", 0},
      {"PROPFIND /", 1}, {"\xff\xfb", 0},
  };
  for (const PassRow& row : kRows) {
    StrangerGuard guard;
    for (std::size_t i = 0; i < row.bytes.size(); ++i) {
      const Verdict verdict = guard.take(static_cast<std::uint8_t>(row.bytes[i]));
      EXPECT_EQ(verdict, i < row.held ? Verdict::kHold : Verdict::kPass) << readable(row.bytes);
    }
    EXPECT_EQ(guard.release(), row.bytes.substr(0, row.held)) << readable(row.bytes);
    EXPECT_EQ(guard.held(), "");
  }
}

TEST(StrangerGuard, NeverLooksAgainLaterOn) {
  Simulation simulation(test::rhino());
  Wire wire(Profile::kPaper);
  wire.send("\r", simulation);
  for (const std::string_view greeting : kGreetings)
    wire.send(std::string(greeting) + "\r", simulation);
  EXPECT_FALSE(wire.is_closed());
  wire.send("E?", simulation);
  EXPECT_EQ(wire.received().back(), ' ');
}

TEST(StrangerGuard, HeldBytesKeepTheirPlaceInTheInput) {
  Simulation simulation(test::rhino());
  Wire wire(Profile::kPaper);
  wire.send("CONZ", simulation);
  ASSERT_EQ(wire.exchanges().size(), 3U);  // O, N, and the unknown byte Z; C is only a label
  EXPECT_EQ(wire.exchanges()[0].parsed.to, 2U);
  EXPECT_EQ(wire.exchanges()[1].parsed.from, 2U);
  EXPECT_EQ(wire.exchanges()[2].parsed.from, 3U);
}

}  // namespace
}  // namespace xr3
