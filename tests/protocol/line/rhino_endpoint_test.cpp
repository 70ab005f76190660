// Bytes in, replies out: commands reach the machine, replies the right line, and the output does
// not depend on the division of the input.
#include "protocol/line/rhino_endpoint.hpp"

#include <gtest/gtest.h>

#include "protocol/explain/diagnostic.hpp"
#include "tests/support/endpoint.hpp"
#include "tests/support/random_bytes.hpp"
#include "tests/support/rig.hpp"
#include "tests/support/wire.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;
using test::RandomBytes;
using test::Rig;
using test::roomy_rhino;
using test::Wire;

struct ReplyRow {
  std::string_view bytes;
  std::string_view paper;
  std::string_view mark3;
};

// At the soft home all switches are open.
TEST(RhinoEndpoint, RepliesToInquiries) {
  constexpr ReplyRow kRows[] = {
      {"E+50\rE?", "R", "R"},
      {"E-10\rET", "\xf6", "\xf6"},
      {"E+100\rE?", "\x84", "\x04"},
      {"E+100 +100\rET", "\xc8", "\xc8"},
      {"E+200\rET", "\0"sv, "\xc8"},
      {"EV", "\0"sv, "\x01"},
      {"I", " ", "_"},
      {"AI", " ", "_"},
      {"J", " ", "P"},
      {"K", " ", " "},
      {"E?E?D?", "   ", "   "},
      {"G? T V", " \0\0"sv, " \0\x01"sv},
      {"G+5\rG?", " ", " "},
      {"E+5 ? T X ?", "%\x05 ", "%\x05 "},
      {"E+5\rA$E?", " ", " "},
      {"E+5\rQE?", " ", " "},
      {"E60S", "", ""},
      {"P1R1LMNO", "", ""},
      {"Z?!", "", ""},
      {"A@E?IA@E?", " ", " "},
  };
  for (const ReplyRow& row : kRows) {
    for (const Profile profile : {Profile::kPaper, Profile::kMark3}) {
      Rig rig(test::rhino(profile));
      Wire wire(rig.simulation.model_ptr());
      wire.send(row.bytes, rig.simulation);
      const std::string_view wanted = profile == Profile::kPaper ? row.paper : row.mark3;
      EXPECT_EQ(hexadecimal(wire.received()), hexadecimal(wanted))
          << readable(row.bytes) << (profile == Profile::kPaper ? ", paper" : ", mark3");
    }
  }
}

TEST(RhinoEndpoint, RepliesAtTheLastByteOfAnInquiry) {
  Rig rig;
  Wire wire(rig.simulation.model_ptr());
  wire.send("E", rig.simulation);
  EXPECT_EQ(wire.received(), "");
  wire.send("?", rig.simulation);
  EXPECT_EQ(wire.received(), " ");
}

TEST(RhinoEndpoint, AMoveStartsAtTheByteAfterItsNumber) {
  Rig rig;
  Wire wire(rig.simulation.model_ptr());
  wire.send("E+5", rig.simulation);
  EXPECT_EQ(rig.error('E'), 0);
  wire.send("\r", rig.simulation);
  EXPECT_EQ(rig.error('E'), 5);
}

TEST(RhinoEndpoint, LinesShareTheMachineButNotTheParser) {
  Rig rig;
  Wire one(rig.simulation.model_ptr());
  Wire other(rig.simulation.model_ptr());
  one.send("E+1", rig.simulation);
  other.send("D+7\rE", rig.simulation);
  one.send("2\r", rig.simulation);
  other.send("?", rig.simulation);
  EXPECT_EQ(rig.error('E'), 12);
  EXPECT_EQ(rig.error('D'), 7);
  EXPECT_EQ(one.received(), "");
  EXPECT_EQ(other.received(), ",");
}

TEST(RhinoEndpoint, ADisabledSimulatorIgnoresAllLines) {
  Rig rig;
  Wire one(rig.simulation.model_ptr());
  Wire other(rig.simulation.model_ptr());
  rig.move('E', 50);
  other.send("E+1", rig.simulation);
  one.send("A@", rig.simulation);
  other.send("0\rE?I", rig.simulation);
  EXPECT_EQ(other.received(), "");
  EXPECT_EQ(other.problems(), (std::vector<std::string>(4, "disabled")));
  rig.pass(100);
  EXPECT_EQ(rig.count('E'), 11) << "a motor that ran goes on";
  other.send("A@E?", rig.simulation);
  EXPECT_EQ(other.received(), "G");
}

TEST(RhinoEndpoint, AnExchangeListsTheItemsOfTheBytes) {
  Rig rig;
  rig.pass(40);
  Wire wire(rig.simulation.model_ptr());
  wire.send("E+100 +100\rE?Z", rig.simulation);
  ASSERT_EQ(wire.exchanges().size(), 4U);
  const Exchange& first = wire.exchanges()[0];
  EXPECT_EQ(test::words(first.parsed), "E+100");
  EXPECT_EQ(first.reply, Reply(NoReply{}));
  EXPECT_EQ(first.events, (Events{{40, MoveTaken{'E', 100, 100}}}));
  const Exchange& second = wire.exchanges()[1];
  EXPECT_EQ(second.parsed.from, 6U);
  EXPECT_EQ(second.parsed.to, 11U);
  EXPECT_EQ(second.events,
            (Events{{40, MoveTaken{'E', 100, -56}},
                    {40, Warning{WarningCode::kCounterOverflow, 'E', 100, -56, {}}}}));
  EXPECT_EQ(wire.exchanges()[2].reply, Reply(ErrorMagnitude{56}));
  EXPECT_EQ(test::words(wire.exchanges()[3].parsed), "unknown_byte");
  EXPECT_TRUE(wire.exchanges()[3].events.empty());
}

TEST(RhinoEndpoint, ResetDiscardsAnIncompleteCommand) {
  Rig rig;
  RhinoEndpoint endpoint(Profile::kPaper);
  std::string replies;
  std::vector<Exchange> exchanges;
  for (const char byte : "E+5"sv) {
    test::feed(endpoint, static_cast<std::uint8_t>(byte), 0, rig.simulation, replies, exchanges);
  }
  endpoint.reset();
  test::feed(endpoint, '\r', 3, rig.simulation, replies, exchanges);
  EXPECT_EQ(rig.error('E'), 0);
  EXPECT_EQ(endpoint.parser(), RhinoParser(Profile::kPaper));
}

TEST(RhinoEndpoint, OnlyInquiriesHaveReplies) {
  RandomBytes random(4);
  Rig rig;
  Wire wire(rig.simulation.model_ptr());
  for (int i = 0; i < 20'000; ++i) {
    const std::size_t before = wire.exchanges().size();
    wire.send(std::string(1, static_cast<char>(random.below(256))), rig.simulation);
    bool asked = false;
    for (std::size_t n = before; n < wire.exchanges().size(); ++n) {
      asked |= !std::holds_alternative<NoReply>(wire.exchanges()[n].reply);
    }
    if (!asked) ASSERT_EQ(wire.received(), "");
    wire.received();
  }
}

// --- However a stream is cut.

struct Moment {
  std::string bytes;
  Tick then_pass = 0;
};

std::vector<Moment> random_day(std::uint32_t seed) {
  RandomBytes random(seed);
  std::vector<Moment> day(1 + random.below(4));
  for (Moment& moment : day) {
    moment.bytes = random.stream(static_cast<int>(1 + random.below(8)));
    moment.then_pass = random.below(200);
  }
  return day;
}

struct Outcome {
  State state;
  std::string replies;
  std::vector<std::string> problems;
  bool is_closed;
  bool operator==(const Outcome&) const = default;
};

// Divides each moment's bytes into pieces of 1 to most_bytes, and its time into as many.
Outcome live(const std::vector<Moment>& day, Profile profile, RandomBytes& random,
             std::uint32_t most_bytes) {
  Rig rig(test::rhino(profile));
  Wire wire(rig.simulation.model_ptr());
  for (const Moment& moment : day) {
    for (std::string_view rest = moment.bytes; !rest.empty();) {
      const std::size_t size = std::min<std::size_t>(rest.size(), 1 + random.below(most_bytes));
      wire.send(rest.substr(0, size), rig.simulation);
      rest.remove_prefix(size);
    }
    const Tick first = random.below(static_cast<std::uint32_t>(moment.then_pass + 1));
    rig.pass(first);
    rig.pass(moment.then_pass - first);
  }
  return {rig.state(), wire.received(), wire.problems(), wire.is_closed()};
}

TEST(RhinoEndpoint, TheDivisionOfTenThousandStreamsDoesNotMatter) {
  for (std::uint32_t seed = 0; seed < 10'000; ++seed) {
    const std::vector<Moment> day = random_day(seed);
    const Profile profile = seed % 2 == 0 ? Profile::kPaper : Profile::kMark3;
    RandomBytes cuts(seed + 1'000'000);
    const Outcome undivided = live(day, profile, cuts, 100'000);
    const Outcome cut = live(day, profile, cuts, 1 + seed % 7);
    ASSERT_EQ(hexadecimal(cut.replies), hexadecimal(undivided.replies)) << "seed " << seed;
    ASSERT_TRUE(cut == undivided) << "seed " << seed;
  }
}

// Guards the property tests: random streams must have effects.
TEST(RhinoEndpoint, TheRandomStreamsContainInquiriesMovesAndErrors) {
  int replies = 0;
  int moved = 0;
  int problems = 0;
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    RandomBytes cuts(seed);
    const Outcome outcome = live(random_day(seed), Profile::kPaper, cuts, 9);
    replies += outcome.replies.empty() ? 0 : 1;
    problems += outcome.problems.empty() ? 0 : 1;
    moved += outcome.state.motors == initial_state(*test::rhino()).motors ? 0 : 1;
  }
  EXPECT_GT(replies, 100);
  EXPECT_GT(moved, 100);
  EXPECT_GT(problems, 50);
}

}  // namespace
}  // namespace xr3
