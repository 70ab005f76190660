// Browsers, TLS and WebRTC clients at the robot port: recognised by their first bytes, before any
// of these is executed.
#include "protocol/line/http_tls_detector.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "core/simulation.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "tests/support/endpoint.hpp"
#include "tests/support/models.hpp"
#include "tests/support/wire.hpp"
#include "tests/support/words.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;
using test::Wire;

// Each is cut below after each of its bytes. The binary ones: TLS, the hello that Chromium sends
// before ICE over "ssltcp", a Binding request of Chromium's ICE over TCP (short and long), a framed
// Allocate, a Binding request without a frame, and Chromium's Allocate for TURN.
constexpr std::string_view kGreetings[] = {
    "GET /"sv,
    "HEAD /"sv,
    "POST /"sv,
    "PUT /"sv,
    "PATCH /"sv,
    "DELETE /"sv,
    "TRACE /"sv,
    "OPTIONS /"sv,
    "CONNECT /"sv,
    "GET http:"sv,
    "POST https:"sv,
    "GET ftp:"sv,
    "GET ws:"sv,
    "GET wss:"sv,
    "OPTIONS https:"sv,
    "OPTIONS *"sv,
    "CONNECT localhost:1"sv,
    "CONNECT [1"sv,
    "PRI *"sv,
    "\x16\x03"sv,
    "\x80\x46\x01\x03\x01"sv,
    "\x00\x70\x00\x01\x00\x5c\x21\x12\xa4\x42"sv,
    "\x01\x5c\x00\x01\x01\x48\x21\x12\xa4\x42"sv,
    "\x00\x1c\x00\x03\x00\x08\x21\x12\xa4\x42"sv,
    "\x00\x01\x00\x5c\x21\x12\xa4\x42"sv,
    "\x00\x03\x00\x08\x21\x12\xa4\x42"sv,
};

TEST(HttpTlsDetector, HoldsAGreetingUntilItsLastByte) {
  for (const std::string_view greeting : kGreetings) {
    HttpTlsDetector detector;
    for (std::size_t i = 0; i + 1 < greeting.size(); ++i) {
      EXPECT_EQ(detector.feed(static_cast<std::uint8_t>(greeting[i])), Detection::kUndecided)
          << greeting;
      EXPECT_EQ(detector.held(), greeting.substr(0, i + 1));
    }
    EXPECT_LE(detector.held().size(), HttpTlsDetector::kMaxHeld);
    EXPECT_EQ(detector.feed(static_cast<std::uint8_t>(greeting.back())),
              Detection::kNotARobotProgram)
        << greeting;
    for (const char later : "E+5\r"sv) {
      EXPECT_EQ(detector.feed(static_cast<std::uint8_t>(later)), Detection::kNotARobotProgram);
    }
  }
}

TEST(HttpTlsDetector, ARequestDoesNotChangeTheState) {
  for (const std::string_view greeting : kGreetings) {
    Simulation simulation(test::rhino());
    const State before = simulation.state();
    Wire wire(simulation.model_ptr());
    wire.send(std::string(greeting) + "E+5\r HTTP/1.1\r\nHost: localhost\r\n\r\nE+100\rP1LNO\r",
              simulation);
    EXPECT_TRUE(wire.is_closed()) << greeting;
    EXPECT_EQ(simulation.state(), before) << greeting;
    EXPECT_EQ(wire.received(), "") << greeting;
    EXPECT_TRUE(wire.exchanges().empty()) << greeting;
  }
}

std::string without_guard(std::string_view bytes, Simulation& simulation) {
  RhinoEndpoint endpoint(Profile::kPaper);
  std::string replies;
  std::vector<Exchange> exchanges;
  for (const char byte : bytes) {
    simulation.take_events();
    test::feed(endpoint, static_cast<std::uint8_t>(byte), 0, simulation, replies, exchanges);
  }
  return replies;
}

// Each opening, cut after each of its bytes and followed by something else, is passed on unchanged.
TEST(HttpTlsDetector, TheFirstDifferentByteReleasesAllBytes) {
  for (const std::string_view greeting : kGreetings) {
    for (std::size_t cut = 0; cut < greeting.size(); ++cut) {
      for (const std::string_view rest : {"?"sv, "X?"sv, "\rE+5?"sv, "1\rI"sv, "\x16?"sv}) {
        const std::string bytes = std::string(greeting.substr(0, cut)) + std::string(rest);
        if (bytes.substr(0, greeting.size()) == greeting) continue;
        Simulation simulation(test::rhino());
        Simulation unguarded(test::rhino());
        Wire wire(simulation.model_ptr());
        wire.send(bytes, simulation);
        EXPECT_FALSE(wire.is_closed()) << readable(bytes);
        EXPECT_EQ(hexadecimal(wire.received()), hexadecimal(without_guard(bytes, unguarded)))
            << readable(bytes);
        EXPECT_EQ(simulation.state(), unguarded.state()) << readable(bytes);
      }
    }
  }
}

/// The number of held bytes and the detection at the next byte; kUndecided if all bytes are held.
std::pair<std::size_t, Detection> judge(std::string_view bytes) {
  HttpTlsDetector detector;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const Detection detection = detector.feed(static_cast<std::uint8_t>(bytes[i]));
    if (detection != Detection::kUndecided) return {i, detection};
  }
  return {bytes.size(), Detection::kUndecided};
}

std::pair<std::size_t, Detection> passes_after(std::size_t held) {
  return {held, Detection::kPass};
}

struct PassRow {
  std::string_view bytes;
  std::size_t held;  ///< number of held bytes before one differs
};

TEST(HttpTlsDetector, PassesOtherBytes) {
  constexpr PassRow kRows[] = {
      {"E", 0},          {"get /", 0},    {"D?", 1},       {"C+5", 1},       {"P3", 1},
      {"PX", 1},         {"PO3", 2},      {"G?", 1},       {"GET\r", 3},     {"GET  /", 4},
      {"GET x", 4},      {"OO", 1},       {"DELETE?", 6},  {"POST\r\n/", 4}, {"HEAD\t/", 4},
      {"\r\nGET /", 0},  {" GET /", 0},   {"\x16\x02", 1}, {"\x16\r", 1},    {"I", 0},
      {"PROPFIND /", 2}, {"\xff\xfb", 0}, {"C?", 1},       {"CX", 1},        {"P1", 1},
      {"R1", 0},         {"PR1", 2},      {"PRI\r", 3},    {"PRI E?", 4},    {"K", 0},
      {"GET E?", 4},     {"GET HC", 4},   {"GET hC", 5},   {"PUT fC", 5},    {"POST w5", 6},
  };
  for (const PassRow& row : kRows) {
    HttpTlsDetector detector;
    for (std::size_t i = 0; i < row.bytes.size(); ++i) {
      const Detection detection = detector.feed(static_cast<std::uint8_t>(row.bytes[i]));
      EXPECT_EQ(detection, i < row.held ? Detection::kUndecided : Detection::kPass)
          << readable(row.bytes);
    }
    EXPECT_EQ(detector.release(), row.bytes.substr(0, row.held)) << readable(row.bytes);
    EXPECT_EQ(detector.held(), "");
  }
}

TEST(HttpTlsDetector, PassesConnectWithoutAPort) {
  constexpr PassRow kRows[] = {
      {"CONNECT \r", 8},       {"CONNECT :", 8},     {"CONNECT E?", 9}, {"CONNECT 9600\r", 12},
      {"CONNECT 96 00:1", 10}, {"CONNECT E:\r", 10}, {"CONNECT [x", 9}, {"CONNECT a/b:1", 9},
  };
  for (const PassRow& row : kRows) {
    EXPECT_EQ(judge(row.bytes), passes_after(row.held)) << readable(row.bytes);
  }
}

TEST(HttpTlsDetector, DetectsConnectWithALongHost) {
  EXPECT_EQ(judge("CONNECT " + std::string(300, 'l')),
            std::pair(HttpTlsDetector::kMaxHeld, Detection::kNotARobotProgram));
}

// STUN begins with a NUL. A robot program may do so, too, and on an 8-bit line with any byte.
TEST(HttpTlsDetector, PassesBinaryBytesOtherThanStun) {
  constexpr PassRow kRows[] = {
      {"\0\0"sv, 1},
      {"\0E?"sv, 1},
      {"\0D?"sv, 2},  // 0x44 may be a length
      {"\0\0E?"sv, 1},
      {"\0\rI"sv, 1},
      {"\0\nI"sv, 1},
      {"\0L\r"sv, 2},
      {"\0L\0\r"sv, 3},
      {"\0\x01I"sv, 2},
      {"\0\x03\0I"sv, 3},
      {"\0\x03\x08"sv, 2},
      {"\0\x05"sv, 1},
      {"\0\x03\0\x08\x21\x12\xa4\x43"sv, 7},
      {"\0p\0\x01\0\x58"sv, 5},  // not the frame's length
      {"\0p\0\x01\0\x5c\x21\x12\xa4\x43"sv, 9},
      {"\x01I"sv, 1},
      {"\x07\xfc\0E?"sv, 3},
      {"\x08\x10"sv, 0},
      {"\x16\xfe"sv, 1},
      {"\x80I"sv, 1},
      {"\x80\x46?"sv, 2},
      {"\x80\x80"sv, 1},
      {"\xff\xfd\0"sv, 0},
      {"\xff\xff"sv, 0},
      {"\r\0p\0\x01"sv, 0},
  };
  for (const PassRow& row : kRows) {
    EXPECT_EQ(judge(row.bytes), passes_after(row.held)) << readable(row.bytes);
  }
}

// A frame's length is a multiple of four, so a one-letter command is executed at once after a NUL,
// too. Only L (0x4c, 0x6c) waits for the next byte.
TEST(HttpTlsDetector, PassesALetterAfterANulAtOnce) {
  for (const char first : {'\0', '\1', '\7'}) {
    for (const char letter : "IJKMNOQijkmnoq"sv) {
      EXPECT_EQ(judge(std::string{first, letter}), passes_after(1)) << letter;
    }
    for (const char letter : "Ll"sv) {
      EXPECT_EQ(judge(std::string{first, letter, '\r'}), passes_after(2)) << letter;
    }
  }
}

TEST(HttpTlsDetector, DetectsEveryStunMessageThatMayComeFirst) {
  for (const char type : {'\x01', '\x03', '\x0b', '\x11'}) {
    for (int length = 0; length < 0x700; length += 52) {
      const auto u16 = [](int value) {
        return std::string{static_cast<char>(value >> 8), static_cast<char>(value & 0xff)};
      };
      const std::string message = std::string{'\0', type} + u16(length) + "\x21\x12\xa4\x42";
      EXPECT_EQ(judge(message), std::pair(std::size_t{7}, Detection::kNotARobotProgram));
      EXPECT_EQ(judge(u16(length + 20) + message),
                std::pair(std::size_t{9}, Detection::kNotARobotProgram));
    }
  }
}

TEST(HttpTlsDetector, PassesEverythingLater) {
  Simulation simulation(test::rhino());
  Wire wire(simulation.model_ptr());
  wire.send("\r", simulation);
  for (const std::string_view greeting : kGreetings)
    wire.send(std::string(greeting) + "\r", simulation);
  EXPECT_FALSE(wire.is_closed());
  wire.send("E?", simulation);
  EXPECT_EQ(wire.received().back(), ' ');
}

TEST(HttpTlsDetector, HeldBytesKeepTheirPosition) {
  Simulation simulation(test::rhino());
  Wire wire(simulation.model_ptr());
  wire.send("CONZ", simulation);
  ASSERT_EQ(wire.exchanges().size(), 3U);  // O, N, and the unknown byte Z; C is only a label
  EXPECT_EQ(wire.exchanges()[0].parsed.to, 2U);
  EXPECT_EQ(wire.exchanges()[1].parsed.from, 2U);
  EXPECT_EQ(wire.exchanges()[2].parsed.from, 3U);
}

}  // namespace
}  // namespace xr3
