// Replies as text, found by the inquiries that were sent.
#include "tools/term/line_decoder.hpp"

#include <gtest/gtest.h>

#include "protocol/line/rhino_endpoint.hpp"
#include "tests/support/endpoint.hpp"
#include "tests/support/models.hpp"
#include "tests/support/random_bytes.hpp"

namespace xr3::term {
namespace {

using Lines = std::vector<std::string>;

ReplyContext without_robot() { return {}; }

ReplyContext with_camera(int width, int height) {
  ReplyContext context;
  context.camera = wire::PictureSize{width, height};
  return context;
}

TEST(LineDecoder, DecodesRepliesInTheOrderOfInquiries) {
  LineDecoder line(without_robot());
  EXPECT_EQ(line.send("E+13\rE?ET?V I"), Lines{});
  EXPECT_EQ(line.unanswered(), 5U);
  EXPECT_EQ(line.receive("-"), Lines{"45  E: 13 counts to go"});
  EXPECT_EQ(line.receive("\xf6!"), (Lines{"246  E: error counter -10", "33  E: 1 count to go"}));
  EXPECT_EQ(line.receive(std::string_view("\0$", 2)),
            (Lines{"0  E: microswitch open", "36  microswitches closed: E"}));
  EXPECT_EQ(line.unanswered(), 0U);
}

TEST(LineDecoder, InquiriesMayArriveInPieces) {
  LineDecoder line(without_robot());
  line.send("E");
  EXPECT_EQ(line.unanswered(), 0U);
  line.send("+5 ");
  line.send("?");
  EXPECT_EQ(line.receive(" "), Lines{"32  E: 0 counts to go"});
}

TEST(LineDecoder, ExplainsIgnoredBytes) {
  LineDecoder line(without_robot());
  EXPECT_EQ(line.send("E+200\r"), Lines{"E+200: a move is -128...127 counts; ignored"});
  EXPECT_EQ(line.send("?"),
            Lines{"?: no joint is selected: a letter A...H must come first on the line; skipped"});
  EXPECT_EQ(line.send("((("), Lines{"(((: no command begins like this here; skipped (3 in a row)"});
  EXPECT_EQ(line.send(std::string(10000, '(')).size(), 1U);
}

TEST(LineDecoder, ExplainsAWordAtItsLineEnd) {
  LineDecoder line(without_robot());
  EXPECT_EQ(line.send("home"), Lines{});
  EXPECT_EQ(line.send("\r"), Lines{"home: the controller has no such word: each letter was a "
                                   "command; A$ returns to the soft home"});
}

TEST(LineDecoder, BytesThatAnswerNothing) {
  LineDecoder line(without_robot());
  EXPECT_EQ(line.receive("A"), Lines{"65  not asked for: A"});
  EXPECT_EQ(line.receive("ok\r\n"), Lines{"4 bytes  not asked for: ok\\r\\n"});
  line.send("EV");
  EXPECT_EQ(line.receive("x?"), (Lines{"120  no reply to EV: x", "63  not asked for: ?"}));
  const Lines lines = line.receive(std::string(5000, 'x'));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_LT(lines[0].size(), 120U);
}

TEST(LineDecoder, PicturesOfAKnownCamera) {
  LineDecoder line(with_camera(10, 3));
  line.send("A**A*2*A*9*E?");
  EXPECT_EQ(line.unanswered(), 3U) << "there is no row 9";
  EXPECT_EQ(line.receive("\\$\\$"), Lines{});
  EXPECT_FALSE(line.is_in_burst());
  EXPECT_EQ(line.receive("\\$\\$ "),
            (Lines{"6 bytes  image of 10 x 3 pixels",
                   "2 bytes  row 2 of the image: 10 pixels: \\\\$", "32  E: 0 counts to go"}));
}

TEST(LineDecoder, AnImageOfUnknownSizeEndsWithTheBurst) {
  LineDecoder line(without_robot());
  line.send("A**E?EV");
  EXPECT_EQ(line.receive("      "), Lines{});
  EXPECT_TRUE(line.is_in_burst());
  EXPECT_EQ(line.receive(std::string_view("   -\0", 5)), Lines{});
  EXPECT_EQ(line.end_of_burst(), (Lines{"9 bytes  image; --robot tells its size",
                                        "45  E: 13 counts to go", "0  E: microswitch open"}));
  EXPECT_EQ(line.unanswered(), 0U);
  EXPECT_EQ(line.end_of_burst(), Lines{});
}

TEST(LineDecoder, RowsOfUnknownSizeHaveOneLength) {
  LineDecoder line(without_robot());
  line.send("A*0*E?A*1*");
  EXPECT_EQ(line.receive("\\$-  "), Lines{});
  EXPECT_EQ(line.end_of_burst(),
            (Lines{"2 bytes  row of the image: \\\\$", "45  E: 13 counts to go",
                   "2 bytes  row of the image:   "}));
}

TEST(LineDecoder, PicturesThatCannotBeToldApart) {
  LineDecoder line(without_robot());
  line.send("A*0*A**");
  line.receive("\\$\\$  ");
  EXPECT_EQ(line.end_of_burst(), Lines{"6 bytes  replies to 2 inquiries"});
  EXPECT_EQ(line.unanswered(), 0U);
}

TEST(LineDecoder, ABurstIsBounded) {
  LineDecoder line(without_robot());
  line.send("A**");
  const std::string megabyte(std::size_t{1} << 20U, ' ');
  EXPECT_EQ(line.receive(megabyte), Lines{});
  EXPECT_EQ(line.receive(" ").size(), 1U);
  EXPECT_EQ(line.unanswered(), 0U);
}

TEST(LineDecoder, GivesUp) {
  LineDecoder line(with_camera(10, 3));
  EXPECT_EQ(line.give_up(), Lines{});
  line.send("E ?F?");
  EXPECT_EQ(line.give_up(), Lines{"no reply to E ? and 1 more"});
  EXPECT_EQ(line.unanswered(), 0U);
  line.send("A*0*");
  line.receive("x");
  EXPECT_EQ(line.give_up(), Lines{"no reply to A*0*; incomplete: 120 x"});
  line.send("E?");
  EXPECT_EQ(line.receive(" "), Lines{"32  E: 0 counts to go"}) << "it goes on afterwards";
}

// Against the controller: every reply is found, whatever is sent.
TEST(LineDecoder, FollowsTheController) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const ModelPtr model = test::model_of(test::robot_named("rhino-xr3"));
    Simulation simulation(model);
    RhinoEndpoint endpoint(model->profile());
    LineDecoder line(context_of(*model));
    const std::string bytes = test::RandomBytes(seed).stream(200);
    std::string replies;
    std::vector<Exchange> exchanges;
    std::uint64_t offset = 0;
    std::size_t lines = 0;
    for (const char byte : bytes) {
      if (!simulation.state().enabled || byte == '@') continue;
      line.send({&byte, 1});
      test::feed(endpoint, static_cast<std::uint8_t>(byte), offset++, simulation, replies,
                 exchanges);
      for (const std::string& text : line.receive(replies)) {
        EXPECT_EQ(text.find("no reply"), std::string::npos) << seed << ": " << text;
        EXPECT_EQ(text.find("not asked"), std::string::npos) << seed << ": " << text;
        ++lines;
      }
      EXPECT_EQ(line.unanswered(), 0U) << "seed " << seed << ", byte " << offset;
      replies.clear();
      exchanges.clear();
    }
    EXPECT_GT(lines, 0U);
  }
}

TEST(HexLines, HaveAMarkAndSixteenBytes) {
  EXPECT_EQ(hex_lines('>', ""), "");
  EXPECT_EQ(hex_lines('>', "E?\r"), "> 45 3f 0d\n");
  EXPECT_EQ(hex_lines('<', "0123456789abcdef\xff"),
            "< 30 31 32 33 34 35 36 37 38 39 61 62 63 64 65 66\n< ff\n");
}

}  // namespace
}  // namespace xr3::term
