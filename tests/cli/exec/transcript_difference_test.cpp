// The sentence about the first difference of two runs.
#include "cli/exec/transcript_difference.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

std::string difference(std::string_view one, std::string_view other) {
  return first_difference({"run 1", one}, {"run 3", other}, Profile::kPaper);
}

TEST(TranscriptDifference, IsTheFirstCommandThatDiffers) {
  EXPECT_EQ(
      difference("0 1 > F+17\\r\n7 1 > F?\n30 1 < R\n31 1 > F+2\\r\n",
                 "0 1 > F+17\\r\n7 1 > F?\n30 1 < R\n31 1 > F+20\\r\n"),
      "run 1 and run 3 differ first on line 1 after 7 bytes: run 1 sent F+2\\r (move F +2) at "
      "tick 31, run 3 sent F+20\\r (move F +20) at tick 31");
}

TEST(TranscriptDifference, DoesNotDependOnPackets) {
  EXPECT_EQ(
      difference("0 1 > E?E\n0 1 > ?\n20 1 < 0\n45 1 < 0\n46 1 > F?\n",
                 "0 1 > E?\n20 1 < 0\n20 1 > E?\n45 1 < 0\n47 1 > D?\n"),
      "run 1 and run 3 differ first on line 1 after 4 bytes: run 1 sent F? (asks how far F has "
      "still to go) at tick 46, run 3 sent D? (asks how far D has still to go) at tick 47");
}

TEST(TranscriptDifference, NamesTheEndOfARun) {
  EXPECT_EQ(difference("0 1 > E+5\\r\n", "0 1 > E+5\\r\n9 1 > \\x00\\xff\\\\\\n\n"),
            "run 1 and run 3 differ first on line 1 after 4 bytes: run 1 sent nothing more, run 3 "
            "sent \\0\\xff at tick 9");
  EXPECT_EQ(difference("", "4 2 > F-\n"),
            "run 1 and run 3 differ first on line 2 after 0 bytes: run 1 sent nothing more, run 3 "
            "sent F- at tick 4");
}

TEST(TranscriptDifference, IsTheEarliestOfAllLines) {
  EXPECT_EQ(
      difference("50 1 > F?\n10 2 > B?\n", "50 1 > E?\n10 2 > C?\n"),
      "run 1 and run 3 differ first on line 2 after 0 bytes: run 1 sent B? (asks how far B has "
      "still to go) at tick 10, run 3 sent C? (asks how far C has still to go) at tick 10");
}

TEST(TranscriptDifference, IsAReplyWhereTheProgramsSentTheSame) {
  EXPECT_EQ(
      difference("0 1 > E?E?\n20 1 < 2\n41 1 < 1\n", "0 1 > E?E?\n20 1 < 2\n42 1 < 1\n"),
      "run 1 and run 3 differ first on line 1 after 1 bytes: run 1 received 1 at tick 41, run 3 "
      "received 1 at tick 42");
}

TEST(TranscriptDifference, SaysIfThereIsNoneInTheText) {
  EXPECT_EQ(
      difference("0 1 > E?\n# the rest is left out\n", "0 1 > E?\n# the rest is left out\n"),
      "run 1 and run 3 have the same bytes in their transcripts: they differ later, or in the "
      "state at the end");
}

}  // namespace
}  // namespace xr3
