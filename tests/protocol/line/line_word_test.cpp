#include "protocol/line/line_word.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "protocol/line/rhino_parser.hpp"
#include "tests/support/words.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;

std::vector<Parsed> fed(LineWord& word, std::string_view bytes) {
  std::vector<Parsed> found;
  std::uint64_t offset = 0;
  for (const char byte : bytes) {
    if (const auto item = word.feed(static_cast<std::uint8_t>(byte), offset++))
      found.push_back(*item);
  }
  return found;
}

/// The purpose of each word that ends a line of `bytes`.
std::vector<Subject> subjects_in(std::string_view bytes) {
  LineWord word;
  std::vector<Subject> subjects;
  for (const Parsed& item : fed(word, bytes))
    subjects.push_back(std::get<Problem>(item.what).subject);
  return subjects;
}

using Subjects = std::vector<Subject>;

TEST(LineWord, FindsTheWords) {
  EXPECT_EQ(subjects_in("help\rhello\r"), (Subjects{Subject::kHelp, Subject::kHelp}));
  EXPECT_EQ(subjects_in("quit\rexit\rbye\rlogout\r"), Subjects(4, Subject::kLeaving));
  EXPECT_EQ(subjects_in("stop\rhalt\r"), Subjects(2, Subject::kStopping));
  EXPECT_EQ(subjects_in("home\rreset\r"), (Subjects{Subject::kHoming, Subject::kResetting}));
  EXPECT_EQ(subjects_in("open\rclose\r"), Subjects(2, Subject::kJaws));
}

TEST(LineWord, CapitalsBlanksBeforeItAndAnyLineEnd) {
  for (const std::string_view line : {"HELP\r"sv, "Help\n"sv, "  help\r\n"sv, "\0help\r\0"sv})
    EXPECT_EQ(subjects_in(line), Subjects{Subject::kHelp});
}

TEST(LineWord, OtherLinesAreNone) {
  for (const std::string_view line : {"\r\n"sv, "help"sv, "hel\r"sv, "helpp\r"sv, "logoutx\r"sv,
                                      "he lp\r"sv, "xhelp\r"sv, "help E+5\r"sv, "E+5\rhelp?\r"sv,
                                      "h\relp\r"sv, "HI\r"sv, "E+5\r"sv, "\xff\r"sv, "hel0\r"sv})
    EXPECT_EQ(subjects_in(line), Subjects{}) << line;
}

TEST(LineWord, HasTheBytesOfTheLine) {
  LineWord word;
  const std::vector<Parsed> found = fed(word, "E?\r  Quit\r");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].from, 5U);
  EXPECT_EQ(found[0].to, 10U);
  EXPECT_EQ(found[0].raw.view(), "Quit\r");
}

TEST(LineWord, ALineEndMakesItNew) {
  for (const std::string_view line : {"help\r"sv, "hel\r"sv, "E+5\r"sv, "  \r"sv}) {
    LineWord word;
    fed(word, line);
    EXPECT_EQ(word, LineWord());
  }
}

TEST(LineWord, DoesNotBelongToTheStateOfTheParser) {
  const auto parser_after = [](std::string_view bytes) {
    RhinoParser parser(Profile::kPaper);
    std::vector<Parsed> parsed;
    std::uint64_t offset = 0;
    for (const char byte : bytes) parser.feed(static_cast<std::uint8_t>(byte), offset++, parsed);
    return parser;
  };
  const auto state_of = [](const RhinoParser& parser) {
    StateWriter out;
    parser.write_state(out);
    return out.bytes();
  };
  const RhinoParser in_a_word = parser_after("LO");
  const RhinoParser in_none = parser_after("OO");
  EXPECT_NE(in_a_word, in_none);
  EXPECT_EQ(state_of(in_a_word), state_of(in_none));
}

}  // namespace
}  // namespace xr3
