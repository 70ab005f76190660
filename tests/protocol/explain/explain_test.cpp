// Explanations of bytes: transcripts of a line with the texts below each record.
#include "protocol/explain/explain.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/kinematics.hpp"
#include "protocol/explain/command_text.hpp"
#include "protocol/explain/reply_decoder.hpp"
#include "protocol/json/source.hpp"
#include "tests/support/endpoint.hpp"
#include "tests/support/models.hpp"
#include "tests/support/rig.hpp"
#include "tests/support/tap.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;
using test::Tap;

ModelPtr seeing_rhino() {
  return std::make_shared<const Model>(test::robot_named("rhino-xr3"),
                                       test::workcell_named("rhino-xr3"), Profile::kPaper);
}

TEST(Explain, AMoveAndItsRemainingCounts) {
  Tap tap(test::rhino());
  EXPECT_EQ(tap.send("E+5\r"),
            "> E+5\\r\n"
            "  0..4 move: move E +5, counter 5\n");
  EXPECT_EQ(tap.send("E-3\rE?"),
            "> E-3\\rE?\n"
            "  4..8 move: move E -3, counter 2\n"
            "  8..10 query_error: asks how far E has still to go\n"
            "< \"\n"
            "  0..1 reply_error: E: 2 counts to go\n");
}

TEST(Explain, BytesOfAnIncompleteCommand) {
  Tap tap(test::rhino());
  EXPECT_EQ(tap.send("E"), "> E\n");
  EXPECT_EQ(tap.send("+"), "> +\n");
  EXPECT_EQ(tap.send("5"), "> 5\n");
  EXPECT_EQ(tap.send("\r"),
            "> \\r\n"
            "  0..4 move: move E +5, counter 5\n");
  EXPECT_EQ(tap.send("\n"), "> \\n\n");
}

TEST(Explain, WarningsWhenNothingMoves) {
  Tap tap(test::rhino());
  EXPECT_EQ(tap.send("E+200\r"),
            "> E+200\\r\n"
            "  0..6 number_out_of_range: E+200: a move is -128...127 counts; ignored\n");
  EXPECT_EQ(tap.send("G+5\r"),
            "> G+5\\r\n"
            "  6..10 move: move G +5\n"
            "  6..10 no_such_joint: G: this robot has no such joint; it has A...F\n");
  EXPECT_EQ(
      tap.send("E+100 E+100\r"),
      "> E+100 E+100\\r\n"
      "  10..16 move: move E +100, counter 100\n"
      "  16..22 move: move E +100, counter -56\n"
      "  16..22 counter_overflow: E+100: the 8-bit error counter wrapped to -56; wait until E "
      "is nearer to its target before sending more\n");
  EXPECT_EQ(tap.send("P9P\r"),
            "> P9P\\r\n"
            "  22..24 number_out_of_range: P9: output lines are 1...8; ignored\n"
            "  24..25 incomplete_command: P: P and R need the number of an output line, 1...8; "
            "ignored\n");
}

TEST(Explain, AMotorAtItsLimitIsReportedAtOnce) {
  Tap tap(test::rhino());
  tap.send("A-100\r");
  tap.simulation().run_to_rest(200'000);
  EXPECT_EQ(tap.send("AXA-5\r"),
            "> AXA-5\\r\n"
            "  6..8 stop: stop A, counter 0\n"
            "  8..12 move: move A -5, counter -5\n"
            "  8..12 limit: A is at its upper limit of 63.5 mm, 5 counts short\n");
  EXPECT_EQ(tap.send("A-1\r"),
            "> A-1\\r\n"
            "  12..16 move: move A -1, counter -6\n"
            "  12..16 limit: A is already at a limit; it can move the other way\n");
  EXPECT_EQ(tap.send("A+10\r"),
            "> A+10\\r\n"
            "  16..21 move: move A +10, counter 4\n");
}

TEST(Explain, AStallNamesTheCommandThatEndsIt) {
  Tap tap(test::rhino());
  State state = tap.simulation().state();
  state.stall = Stall::kProtectedRegion;
  tap.simulation().restore(state);
  EXPECT_EQ(tap.send("E+5\r"),
            "> E+5\\r\n"
            "  0..4 move: move E +5, counter 5\n"
            "  0..4 protected_region: nothing moves: the tool would enter the protected region; A$ "
            "or reset clears the stall\n");
  EXPECT_EQ(tap.send("A$E+1\r"),
            "> A$E+1\\r\n"
            "  4..6 soft_home: soft home: every joint at its home value, counters 0, no stall\n"
            "  6..10 move: move E +1, counter 1\n");
}

TEST(Explain, ASoftHomeThatDropsABlockSaysHowHigh) {
  Tap tap(test::rhino());
  const PointUm tip = tool_tip(tap.simulation().model(), Positions{});
  tap.simulation().edit().blocks = {{"red", {20'000, 20'000, 20'000}, tip, 90'000'000, 1}};
  tap.send("A+100\r");
  tap.simulation().run_to_rest(200'000);
  EXPECT_EQ(tap.send("A$"),
            "> A$\n"
            "  6..8 soft_home: soft home: every joint at its home value, counters 0, no stall\n"
            "  6..8 released_in_air: the block was released 310.7 mm above what is below it and "
            "stays in the air: release it lower\n");
}

TEST(Explain, JunkIsReportedPerRun) {
  Tap tap(test::rhino());
  EXPECT_EQ(tap.send("xyz"),
            "> xyz\n"
            "  0..1 no_joint_selected: x: no joint is selected: a letter A...H must come first on "
            "the line; skipped\n"
            "  1..3 unknown_byte: yz: no command begins like this here; skipped (2 in a row)\n");
  EXPECT_EQ(tap.send(std::string(40, '#')),
            "> ########################################\n"
            "  3..43 unknown_byte: ######################...: no command begins like this here; "
            "skipped (40 in a row)\n");
}

TEST(Explain, AWordIsExplainedBehindItsLetters) {
  Tap tap(test::rhino());
  EXPECT_EQ(tap.send("help\r"),
            "> help\\r\n"
            "  1..3 auxiliary_1_on: auxiliary port 1 on\n"
            "  3..4 incomplete_command: p: P and R need the number of an output line, 1...8; "
            "ignored\n"
            "  0..5 word: help: the controller has no such word: each letter was a command; E+50 "
            "moves joint E, E? asks how far it has to go, and docs/protocol.md has all commands\n");
  const std::string quit = tap.send("QUIT\r");
  EXPECT_NE(quit.find("\n  5..10 word: QUIT: the controller has no such word: each letter was a "
                      "command; to leave, close the connection: ~. in xr3 term, Ctrl-] and quit in "
                      "telnet, Ctrl-C in nc\n<"),
            std::string::npos)
      << quit;
}

TEST(Explain, CountsAreWholeNumbers) {
  Tap tap(test::rhino());
  EXPECT_EQ(tap.send("E+2.5\r"),
            "> E+2.5\\r\n"
            "  0..3 move: move E +2, counter 2\n"
            "  3..4 decimal_point: .: counts and speeds are whole numbers: the number ended before "
            "the point; skipped\n"
            "  4..5 unknown_byte: 5: skipped: after an unknown byte, numbers are ignored up to the "
            "next letter\n");
  EXPECT_EQ(tap.send("A+2.5\r"),
            "> A+2.5\\r\n"
            "  6..9 move: move A +2, counter 2\n"
            "  9..10 decimal_point: .: counts are whole numbers: the number ended before the "
            "point, and A. sets the refresh period\n"
            "  9..12 set_refresh_period: display redrawn every 2.5 s\n");
}

TEST(Explain, SpeedsStopsAndReset) {
  Tap tap(test::rhino());
  EXPECT_EQ(tap.send("E60SEXQ"),
            "> E60SEXQ\n"
            "  0..4 set_speed: speed of E: 60 counts a second\n"
            "  4..6 stop: stop E, counter 0\n"
            "  6..7 controller_reset: controller reset: counters 0, outputs and ports off, speeds "
            "of the robot file; it does not send the robot home\n");
}

TEST(Explain, TogglesReportTheNewSetting) {
  Tap tap(test::rhino());
  EXPECT_EQ(tap.send("A#A#A#"),
            "> A#A#A#\n"
            "  0..2 toggle_display: display on\n"
            "  2..4 toggle_display: display off\n"
            "  4..6 toggle_display: display on\n");
  EXPECT_EQ(tap.send("A|A|"),
            "> A|A|\n"
            "  6..8 toggle_erasing: erasing off: the tool leaves its path\n"
            "  8..10 toggle_erasing: erasing on: earlier pictures are erased\n");
  EXPECT_EQ(tap.send("A@E?A@"),
            "> A@E?A@\n"
            "  10..12 toggle_simulator: simulator disabled: only A@ is executed from now on\n"
            "  12..14 disabled: E?: the simulator is disabled and executes only A@ (2 in a row)\n"
            "  14..16 toggle_simulator: simulator enabled\n");
}

TEST(Explain, OtherEnvironmentCommands) {
  Tap tap(test::rhino());
  EXPECT_EQ(tap.send("A!1,-2,3!A.5 A%3"),
            "> A!1,-2,3!A.5 A%3\n"
            "  0..9 set_view_vector: view along 1,-2,3\n"
            "  9..13 set_refresh_period: display redrawn every 2.5 s\n"
            "  13..16 select_status: status line 3: error counters\n");
}

TEST(Explain, DigitalLinesAndTheirAnswers) {
  Tap tap(test::rhino());
  tap.simulation().set_input(2, true);
  tap.simulation().set_input(7, true);
  EXPECT_EQ(tap.send("P2R3LO"),
            "> P2R3LO\n"
            "  0..2 output_high: output 2 high\n"
            "  2..4 output_low: output 3 low\n"
            "  4..5 auxiliary_1_on: auxiliary port 1 on\n"
            "  5..6 auxiliary_2_off: auxiliary port 2 off\n");
  EXPECT_EQ(tap.send("JK"),
            "> JK\n"
            "  6..7 query_switches_j: asks for the microswitches of A and B and for input lines "
            "5...8\n"
            "  7..8 query_inputs: asks for input lines 1...4\n"
            "< $\"\n"
            "  0..1 reply_switches: no microswitch closed; input lines high: 7\n"
            "  1..2 reply_inputs: input lines high: 2\n");
}

TEST(Explain, Switches) {
  Tap tap(test::rhino());
  const Model& model = tap.simulation().model();
  const auto at_switch = [&model](int index) {
    return model.motor(index).drive.microswitch.position;
  };
  tap.simulation().restore(test::state_at(model, {{'E', at_switch(1)}, {'C', at_switch(3)}}));
  EXPECT_EQ(tap.send("IEVDV"),
            "> IEVDV\n"
            "  0..1 query_switches_i: asks for the microswitches of C...H\n"
            "  1..3 query_switch: asks for the microswitch of E\n"
            "  3..5 query_switch: asks for the microswitch of D\n"
            "< %\\x01\\0\n"
            "  0..1 reply_switches: microswitches closed: E, C\n"
            "  1..2 reply_switch: E: microswitch closed\n"
            "  2..3 reply_switch: D: microswitch open\n");
}

TEST(Explain, SignedCountersAndOneCount) {
  Tap tap(test::rhino());
  EXPECT_EQ(tap.send("E-1\rET?"),
            "> E-1\\rET?\n"
            "  0..4 move: move E -1, counter -1\n"
            "  4..6 query_signed_error: asks for the error counter of E with its sign\n"
            "  6..7 query_error: asks how far E has still to go\n"
            "< \\xff!\n"
            "  0..1 reply_signed_error: E: error counter -1\n"
            "  1..2 reply_error: E: 1 count to go\n");
}

TEST(Explain, Mark3RepliesLoseTheTopBit) {
  Tap tap(test::rhino(Profile::kMark3));
  EXPECT_EQ(tap.send("E+100\rE?"),
            "> E+100\\rE?\n"
            "  0..6 move: move E +100, counter 100\n"
            "  6..8 query_error: asks how far E has still to go\n"
            "< \\x04\n"
            "  0..1 reply_error: E: 100 counts to go, sent without its top bit\n");
}

TEST(Explain, TheCamera) {
  Tap tap(seeing_rhino());
  EXPECT_EQ(tap.send("A*63,0*A*9999*A*1*"),
            "> A*63,0*A*9999*A*1*\n"
            "  0..7 camera_pixel: asks for the pixel in column 63, row 0\n"
            "  7..14 camera_row: asks for row 9999 of the camera's image\n"
            "  7..14 bad_camera_argument: the camera has columns 0...191 and rows 0...191; not "
            "answered\n"
            "  14..18 camera_row: asks for row 1 of the camera's image\n"
            "< " +
                std::string(33, ' ') +
                "\n"
                "  0..1 reply_pixel: pixel in column 63, row 0: 0, no block\n"
                "  1..33 reply_row: row 1 of the image: 192 pixels\n");
  const std::string image = tap.send("A**");
  EXPECT_NE(image.find("  33..6177 reply_image: image of 192 x 192 pixels\n"), std::string::npos)
      << image;
}

TEST(Explain, TelnetBytesAreSeparate) {
  Tap tap(test::rhino());
  EXPECT_EQ(tap.send("E+5\xff\xfb\x01\r"),
            "> E+5\\xff\\xfb\\x01\\r\n"
            "  3..6 telnet: telnet protocol; not passed to the controller\n"
            "  0..7 move: move E +5, counter 5\n"
            "< \\xff\\xfe\\x01\n"
            "  0..3 telnet: telnet protocol; not sent by the controller\n");
  EXPECT_EQ(tap.send("\xff"sv),
            "> \\xff\n"
            "  7..8 telnet: telnet protocol; not passed to the controller\n");
  EXPECT_EQ(tap.send("\xfd\x06"
                     "EX-1\rET"sv),
            "> \\xfd\\x06EX-1\\rET\n"
            "  8..10 telnet: telnet protocol; not passed to the controller\n"
            "  10..12 stop: stop E, counter 0\n"
            "  12..15 move: move E -1, counter -1\n"
            "  15..17 query_signed_error: asks for the error counter of E with its sign\n"
            "< \\xff\\xfb\\x06\\xff\\xff\n"
            "  3..6 telnet: telnet protocol; not sent by the controller\n"
            "  6..8 reply_signed_error: E: error counter -1\n");
}

TEST(Explain, RepliesThatTheClientHadSuspended) {
  Tap tap(test::rhino());
  tap.send("\r\xff\xfb\x2c\xff\xfa\x2c\x08\xff\xf0"sv);
  EXPECT_EQ(tap.send("E+5\rE?"),
            "> E+5\\rE?\n"
            "  10..14 move: move E +5, counter 5\n"
            "  14..16 query_error: asks how far E has still to go\n");
  EXPECT_EQ(tap.send("D?\xff\xfa\x2c\x09\xff\xf0?"sv),
            "> D?\\xff\\xfa,\\x09\\xff\\xf0?\n"
            "  16..18 query_error: asks how far D has still to go\n"
            "  18..24 telnet: telnet protocol; not passed to the controller\n"
            "  24..25 query_error: asks how far D has still to go\n"
            "< %  \n"
            "  10..11 reply_error: E: 5 counts to go\n"
            "  11..12 reply_error: D: 0 counts to go\n"
            "  12..13 reply_error: D: 0 counts to go\n");
}

TEST(Explain, ManyRepliesThatTheClientHadSuspended) {
  Tap tap(test::rhino());
  tap.send("\r\xff\xfb\x2c\xff\xfa\x2c\x08\xff\xf0"sv);
  tap.send(std::string(1000, 'I'));
  const std::string sent = tap.send("\xff\xfa\x2c\x09\xff\xf0"sv);
  EXPECT_NE(sent.find("\n  266..1010 more_replies: 744 more replies that were held\n"),
            std::string::npos)
      << sent;
}

TEST(Explain, WithoutATelnetFilterTheControllerGetsEveryByte) {
  Simulation simulation(test::rhino());
  RhinoEndpoint endpoint(Profile::kPaper);
  std::vector<Exchange> exchanges;
  std::string replies;
  test::feed(endpoint, 0xff, 0, simulation, replies, exchanges);
  WireRecord record;
  fill_in(record, {}, "\xff", std::nullopt, exchanges, simulation);
  EXPECT_EQ(test::transcript(record, simulation.model()),
            "> \\xff\n"
            "  0..1 unknown_byte: \\xff: no command begins like this here; skipped\n");
}

// The names in data/commands.json are the codes.
TEST(Explain, EveryDocumentedCommandHasACode) {
  const Json commands = Json::parse(test::project_file("data/commands.json"));
  std::set<std::string> named;
  std::set<std::string> obeyed;
  for (const auto& [part, list] : commands.items()) {
    if (!list.is_array()) continue;
    for (const Json& command : list) {
      named.insert(command["name"].get<std::string>());
      Tap tap(seeing_rhino());
      tap.send(command["example"].get<std::string>() + "\r");
      for (const wire::Item& item : tap.records().front().items) {
        const auto* done = std::get_if<wire::Executed>(&item.what);
        if (done == nullptr) continue;
        obeyed.emplace(code_of(done->command));
        EXPECT_FALSE(command_text(*done).phrase.empty());
      }
    }
  }
  EXPECT_EQ(obeyed, named);
  EXPECT_GT(named.size(), 20U);
}

// A client decodes every reply: reply_decoder.cpp is the inverse of rhino_reply.cpp.
TEST(Explain, EveryDocumentedReplyIsDecoded) {
  const ModelPtr model = seeing_rhino();
  const ReplyContext context = context_of(*model);
  const Json commands = Json::parse(test::project_file("data/commands.json"));
  for (const auto& [part, list] : commands.items()) {
    if (!list.is_array()) continue;
    for (const Json& command : list) {
      Tap tap(model);
      tap.send(command["example"].get<std::string>() + "\r");
      const std::string& reply = tap.received();
      EXPECT_EQ(reply.empty(), command["reply"].is_null()) << command["form"];
      for (const wire::Item& item : tap.records().front().items) {
        const auto* done = std::get_if<wire::Executed>(&item.what);
        if (done == nullptr) continue;
        ASSERT_EQ(reply_size(done->command, context), reply.size()) << command["form"];
        if (!reply.empty())
          EXPECT_TRUE(decode_reply(done->command, reply, context)) << command["form"];
      }
    }
  }
}

/// The names of the commands in `bytes`, each with a comma behind it; problems are skipped.
std::string commands_in(const std::string& bytes) {
  RhinoParser parser(Profile::kPaper);
  std::vector<Parsed> all;
  for (const char byte : bytes) parser.feed(static_cast<std::uint8_t>(byte), 0, all);
  std::string names;
  for (const Parsed& parsed : all) {
    const auto* command = std::get_if<Command>(&parsed.what);
    if (command != nullptr) names += std::string(code_of(*command)) + ",";
  }
  return names;
}

/// The bytes of the command with this value of one argument; the label is E, other arguments are 1.
std::string with_argument(const Json& command, const std::string& name, int value) {
  std::string bytes;
  for (const char c : command["form"].get<std::string>()) {
    const bool is_argument = c >= 'a' && c <= 'z';
    const std::string other = c == 'a' ? "E" : "1";
    bytes += !is_argument ? std::string{c} : name == std::string{c} ? std::to_string(value) : other;
  }
  return bytes + "\r";
}

TEST(Explain, TheParserHasTheRangesOfTheDocumentedSet) {
  int ranges = 0;
  const Json commands = Json::parse(test::project_file("data/commands.json"));
  for (const auto& [part, list] : commands.items()) {
    if (!list.is_array()) continue;
    for (const Json& command : list) {
      const std::string code = command["name"].get<std::string>() + ",";
      for (const Json& argument : command["arguments"]) {
        if (!argument.contains("max") || !argument["max"].is_number()) continue;
        const auto name = argument["name"].get<std::string>();
        const int min = argument["min"];
        const int max = argument["max"];
        EXPECT_EQ(commands_in(with_argument(command, name, min)), code) << command["form"];
        EXPECT_EQ(commands_in(with_argument(command, name, max)), code) << command["form"];
        EXPECT_EQ(commands_in(with_argument(command, name, min - 1)), "") << command["form"];
        EXPECT_EQ(commands_in(with_argument(command, name, max + 1)), "") << command["form"];
        ++ranges;
      }
    }
  }
  EXPECT_GE(ranges, 9);
}

}  // namespace
}  // namespace xr3
