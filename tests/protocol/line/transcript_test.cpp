// Plays every file of tests/transcripts as a test, and proves that the player detects differences.
#include "tests/support/transcript.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/support/models.hpp"

namespace xr3::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> transcript_names() {
  std::vector<std::string> names;
  const std::filesystem::path folder = std::filesystem::path(XR3_SOURCE_DIR) / "tests/transcripts";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".txt") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class TranscriptFile : public ::testing::TestWithParam<std::string> {};

TEST_P(TranscriptFile, GivesTheWrittenReplies) {
  const std::string path = "tests/transcripts/" + GetParam() + ".txt";
  const Transcript transcript = parse_transcript(project_file(path), path);
  const auto expects = [](const TranscriptStep& step) {
    return step.kind == StepKind::kExpect || step.kind == StepKind::kClosed;
  };
  EXPECT_TRUE(std::any_of(transcript.steps.begin(), transcript.steps.end(), expects))
      << path << " expects nothing";
  for (const std::string& failure : play(transcript)) ADD_FAILURE() << failure;
}

INSTANTIATE_TEST_SUITE_P(All, TranscriptFile, ::testing::ValuesIn(transcript_names()),
                         [](const auto& name) {
                           std::string word = name.param;
                           std::replace(word.begin(), word.end(), '-', '_');
                           return word;
                         });

std::vector<std::string> played(std::string_view text) {
  return play(parse_transcript(text, "t.txt"));
}

TEST(TranscriptPlayer, DetectsAWrongReply) {
  EXPECT_THAT(played("# first\n> E?\n< !\n"),
              ElementsAre("t.txt:3: line 1: expected '!', got ' '"));
}

TEST(TranscriptPlayer, DetectsAMissingReply) {
  EXPECT_THAT(played("> E\n< R\n"), ElementsAre("t.txt:2: line 1: expected 'R', got nothing"));
}

TEST(TranscriptPlayer, DetectsAnUnexpectedReply) {
  EXPECT_THAT(played("> E?\n<\n"), ElementsAre("t.txt:2: line 1: expected nothing, got ' '"));
  EXPECT_THAT(played("> ET\n~ 1ms\n"), ElementsAre("t.txt:2: line 1: expected nothing, got '\\0'"));
  EXPECT_THAT(played("2> ET\n! hang up\n2! hang up\n"),
              ElementsAre("t.txt:3: line 2: expected nothing, got '\\0'"));
}

TEST(TranscriptPlayer, DetectsALineThatIsStillOpen) {
  EXPECT_THAT(played("> GET\n! closed\n"),
              ElementsAre(HasSubstr("t.txt:2: expected the line closed")));
}

TEST(TranscriptPlayer, AReplyIsEverythingSinceTheLastOne) {
  EXPECT_THAT(played("> E+5\\rE?\n> E?\n< %%\n> E\n"), IsEmpty());
}

TEST(TranscriptPlayer, AdvancesTimeAndSeparatesLines) {
  EXPECT_THAT(played("> E+11\\r\n2> E?\n~ 100ms\n2> E?\n2< +\\x20\n~ 1s\n> E?\n< \\x20\n"),
              IsEmpty());
}

struct BrokenRow {
  std::string_view text;
  std::string_view why;
};

TEST(TranscriptPlayer, RejectsAMalformedFileWithItsLine) {
  constexpr BrokenRow kRows[] = {
      {"E+5\n", "t.txt:1: a blank follows the sign"},
      {"\n\n= 5\n", "t.txt:3: a line begins with"},
      {"> E \n", "t.txt:1: a blank at the end"},
      {"> \\q\n", "t.txt:1: no such escape"},
      {"> \\x4\n", "t.txt:1: no such escape"},
      {"> \\x4G\n", "t.txt:1: \\x wants"},
      {"~ 5\n", "t.txt:1: a duration is in ms or s"},
      {"~ soon\n", "t.txt:1: no duration"},
      {"@ compat mark4\n", "t.txt:1: no such option"},
      {"@ compat\n", "t.txt:1: an option is a name"},
      {"> E?\n@ compat mark3\n", "t.txt:2: options come first"},
      {"! open\n", "t.txt:1: a line begins with"},
      {"> \xc3\xa9\n", "t.txt:1: a byte that is not printable"},
  };
  for (const BrokenRow& row : kRows) {
    try {
      parse_transcript(row.text, "t.txt");
      ADD_FAILURE() << "accepted: " << row.text;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr(std::string(row.why)));
    }
  }
}

}  // namespace
}  // namespace xr3::test
