// The commands of the serial line as tables: bytes on the left, their meaning on the right, each
// command in its shortest form and each problem by its code.
#include "protocol/line/rhino_parser.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "protocol/explain/diagnostic.hpp"
#include "protocol/json/values.hpp"
#include "tests/support/models.hpp"
#include "tests/support/words.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;
using test::words;

std::vector<Parsed> parse(std::string_view bytes, Profile profile = Profile::kPaper) {
  RhinoParser parser(profile);
  std::vector<Parsed> parsed;
  std::uint64_t offset = 0;
  for (const char byte : bytes) parser.feed(static_cast<std::uint8_t>(byte), offset++, parsed);
  return parsed;
}

struct ParsedRow {
  std::string_view bytes;
  std::string_view meaning;  ///< items with a blank between them
};

void expect_rows(std::initializer_list<ParsedRow> rows, Profile profile = Profile::kPaper) {
  for (const ParsedRow& row : rows) {
    EXPECT_EQ(words(parse(row.bytes, profile)), row.meaning) << "of " << readable(row.bytes);
  }
}

void expect_rows_in_both_profiles(std::initializer_list<ParsedRow> rows) {
  expect_rows(rows, Profile::kPaper);
  expect_rows(rows, Profile::kMark3);
}

TEST(RhinoParser, MotionCommands) {
  expect_rows_in_both_profiles({
      {"E+5\r", "E+5"},     {"E-5\r", "E-5"}, {"E5\r", "E+5"}, {"E127\r", "E+127"},
      {"E-128\r", "E-128"}, {"E60S", "E60S"}, {"E1S", "E1S"},  {"E255S", "E255S"},
      {"EX", "EX"},         {"E?", "E?"},     {"ET", "ET"},    {"EV", "EV"},
      {"I", "I"},           {"AI", "I"},      {"J", "J"},      {"AJ", "J"},
      {"K", "K"},           {"L", "L"},       {"M", "M"},      {"N", "N"},
      {"O", "O"},           {"P1", "P1"},     {"P8", "P8"},    {"R1", "R1"},
      {"R8", "R8"},         {"Q", "Q"},
  });
}

TEST(RhinoParser, EveryLetterFromAToHIsALabel) {
  for (char label = 'A'; label <= 'H'; ++label) {
    const std::string upper(1, label);
    const std::string lower(1, static_cast<char>(label - 'A' + 'a'));
    for (const std::string& letter : {upper, lower}) {
      EXPECT_EQ(words(parse(letter + "+7\r")), upper + "+7");
      EXPECT_EQ(words(parse(letter + "?")), upper + "?");
      EXPECT_EQ(words(parse(letter + "9s")), upper + "9S");
    }
  }
}

TEST(RhinoParser, AcceptsSmallLetters) {
  expect_rows_in_both_profiles({
      {"e+5x", "E+5 EX"},
      {"et", "ET"},
      {"ev", "EV"},
      {"i", "I"},
      {"ai", "I"},
      {"j", "J"},
      {"k", "K"},
      {"lmno", "L M N O"},
      {"p3r4", "P3 R4"},
      {"q", "Q"},
      {"a$", "A$"},
      {"a**", "A**"},
      {"e5s", "E5S"},
  });
}

TEST(RhinoParser, ANumberEndsAtTheFirstNonDigit) {
  expect_rows_in_both_profiles({
      {"E+5", ""},
      {"E+5X", "E+5 EX"},
      {"E+5?", "E+5 E?"},
      {"E+5T", "E+5 ET"},
      {"E+5\r\n", "E+5"},
      {"E+5 \r\n", "E+5"},
      {"E+5\n", "E+5"},
      {"E+5\r\0"sv, "E+5"},
      {"E+5\0"sv, "E+5"},
      {"E+5C-3\r", "E+5 C-3"},
      {"E+5-3\r", "E+5 E-3"},
      {"E5 3\r", "E+5 E+3"},
      {"E+5I", "E+5 I"},
      {"E+5P3", "E+5 P3"},
      {"E 5 ", "E+5"},
      {"E  +5 ", "E+5"},
      {"E\0-5\0"sv, "E-5"},
      {"E+5Q", "E+5 Q"},
      {"A+5@", "A+5 A@"},
      {"A+5$", "A+5 A$"},
      {"E+5#", "E+5 unknown_byte"},
  });
}

TEST(RhinoParser, ASpeedIsUnsignedDigitsDirectlyBeforeS) {
  expect_rows_in_both_profiles({
      {"E5S", "E5S"},
      {"E+5S", "E+5 unknown_byte"},
      {"E-5S", "E-5 unknown_byte"},
      {"E5 S", "E+5 unknown_byte"},
      {"ES", "unknown_byte"},
      {"ESX", "unknown_byte EX"},
      {"E0S", "speed_out_of_range"},
      {"E256S", "speed_out_of_range"},
      {"E99999999999S", "speed_out_of_range"},
      {"E0S+5\r", "speed_out_of_range E+5"},
      {"E5S5S", "E5S E5S"},
      {"E005S", "E5S"},
  });
}

TEST(RhinoParser, RejectsIncompleteNumbers) {
  expect_rows_in_both_profiles({
      {"E--5\r", "incomplete_command unknown_byte unknown_byte"},
      {"E+-5\r", "incomplete_command unknown_byte unknown_byte"},
      {"E+X", "incomplete_command EX"},
      {"E+ 5\r", "incomplete_command unknown_byte"},
      {"E+\r5\r", "incomplete_command no_joint_selected"},
      {"E+?", "incomplete_command E?"},
      {"E+C-3\r", "incomplete_command C-3"},
      {"E+S", "incomplete_command unknown_byte"},
  });
}

TEST(RhinoParser, APointEndsANumber) {
  expect_rows_in_both_profiles({
      {"E+2.5\r", "E+2 decimal_point unknown_byte"},
      {"E2.5\rE?", "E+2 decimal_point unknown_byte E?"},
      {"E60.5S", "E+60 decimal_point unknown_byte unknown_byte"},
      {"E+2.X", "E+2 decimal_point EX"},
      {"E+.5\r", "incomplete_command decimal_point unknown_byte"},
      {"A+2.5\r", "A+2 decimal_point A.5"},
      {"A+.5\r", "incomplete_command decimal_point A.5"},
      {"E.5\r", "unknown_byte unknown_byte"},
      {"E+2 .5\r", "E+2 unknown_byte unknown_byte"},
      {"E5S.5\r", "E5S unknown_byte unknown_byte"},
  });
}

TEST(RhinoParser, AWordIsReportedBehindItsLetters) {
  expect_rows_in_both_profiles({
      {"help\r", "L incomplete_command word"},
      {"Exit\r", "EX I ET word"},
      {"home\n", "O M word"},
      {"quit\rE+5\r", "Q unknown_byte I no_joint_selected word E+5"},
      {"helpE+5\r", "L incomplete_command E+5"},
      {"home", "O M"},
  });
}

TEST(RhinoParser, AcceptsZero) {
  expect_rows_in_both_profiles({
      {"E+0\r", "E+0"},
      {"D-0\r", "D+0"},
      {"E000\r", "E+0"},
      {"E-0X", "E+0 EX"},
  });
}

TEST(RhinoParser, ThePaperProfileRejectsNumbersOutOfRange) {
  expect_rows({
      {"E+128\r", "number_out_of_range"},
      {"E-129\r", "number_out_of_range"},
      {"E+200X", "number_out_of_range EX"},
      {"E+4294967301\r", "number_out_of_range"},
      {"E-99999999999999999999999999999\r", "number_out_of_range"},
      {"E0000000000000000000000000000127\r", "E+127"},
      {"E+200\r\nE+5\r\n", "number_out_of_range E+5"},
  });
}

TEST(RhinoParser, TheMark3ProfileTakesNumbersModulo256) {
  expect_rows(
      {
          {"E+128\r", "E-128"},
          {"E-129\r", "E+127"},
          {"E+200\r", "E-56"},
          {"E-200\r", "E+56"},
          {"E+255\r", "E-1"},
          {"E+256\r", "E+0"},
          {"E-256\r", "E+0"},
          {"E+261\r", "E+5"},
          {"E+4294967301\r", "E+5"},
          {"E300S", "speed_out_of_range"},
      },
      Profile::kMark3);
}

TEST(RhinoParser, ALabelStaysSelectedUntilCrLfAnotherLabelOrTheEnvironment) {
  expect_rows_in_both_profiles({
      {"E+5 ? V", "E+5 E? EV"},
      {"E???", "E? E? E?"},
      {"EI?", "I E?"},
      {"EJK?", "J K E?"},
      {"EL?", "L E?"},
      {"EP3+5\r", "P3 E+5"},
      {"EQ?", "Q E?"},
      {"E60S+5\r", "E60S E+5"},
      {"E X", "EX"},
      {"E\0?"sv, "E?"},
      {"E\r?", "no_joint_selected"},
      {"E\n?", "no_joint_selected"},
      {"E+5\r?", "E+5 no_joint_selected"},
      {"EC?", "C?"},
      {"A$?", "A$ no_joint_selected"},
      {"A@+5\r", "A@ no_joint_selected unknown_byte"},
      {"A%2?", "A%2 no_joint_selected"},
      {"A.6\rX", "A.6 no_joint_selected"},
      {"A.6 X", "A.6 no_joint_selected"},
      {"A!!?", "A!1,1,1! no_joint_selected"},
      {"A**T", "A** no_joint_selected"},
      {"AI?", "I A?"},
  });
}

TEST(RhinoParser, AnInquiryNeedsALabel) {
  expect_rows_in_both_profiles({
      {"?", "no_joint_selected"},
      {"T", "no_joint_selected"},
      {"V", "no_joint_selected"},
      {"X", "no_joint_selected"},
      {"S", "no_joint_selected"},
      {"5\r", "no_joint_selected"},
      {"+5\r", "no_joint_selected unknown_byte"},
      {"?E?", "no_joint_selected E?"},
      {"I?", "I no_joint_selected"},
  });
}

TEST(RhinoParser, IgnoresBlanksAndEmptyLines) {
  expect_rows_in_both_profiles({
      {"", ""},
      {"\r\n\r\n", ""},
      {" \0 \r\0\n"sv, ""},
      {"E", ""},
      {"E\r\nE\r\n", ""},
      {"  E  +5  \r\n", "E+5"},
  });
}

TEST(RhinoParser, SkipsJunkAndTheDigitsAfterIt) {
  expect_rows_in_both_profiles({
      {"EZ5\r", "unknown_byte unknown_byte"},
      {"EZ-12\r", "unknown_byte unknown_byte unknown_byte unknown_byte"},
      {"EZ5C5\r", "unknown_byte unknown_byte C+5"},
      {"EZ5E5\r", "unknown_byte unknown_byte E+5"},
      {"EZ?", "unknown_byte E?"},
      {"EZX+5\r", "unknown_byte EX E+5"},
      {"EZ\rE5\r", "unknown_byte E+5"},
      {"E5S S6\r", "E5S unknown_byte unknown_byte"},
      {"E,5\r", "unknown_byte unknown_byte"},
      {"E=5\rE5\r", "unknown_byte unknown_byte E+5"},
      {"\x1b[AE+5\r", "unknown_byte unknown_byte E+5"},
      {"\xc3\xa9", "unknown_byte unknown_byte"},
      {"E+5\t", "E+5 unknown_byte"},
      {"\x7f\x80\xff", "unknown_byte unknown_byte unknown_byte"},
  });
}

TEST(RhinoParser, LettersOfNoCommandAreUnknown) {
  std::string letters = "ABCDEFGH";
  const Json commands = Json::parse(test::project_file("data/commands.json"));
  for (const Json& part : commands) {
    if (!part.is_array()) continue;
    for (const Json& command : part) letters += command["example"].get<std::string>();
  }
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (letters.find(letter) != std::string::npos) continue;
    expect_rows_in_both_profiles({{std::string(1, letter), "unknown_byte"}});
  }
}

TEST(RhinoParser, DigitalLines) {
  expect_rows_in_both_profiles({
      {"P3R3", "P3 R3"},
      {"P 3", "P3"},
      {"P12", "P1 no_joint_selected"},
      {"P0", "number_out_of_range"},
      {"P9", "number_out_of_range"},
      {"R0", "number_out_of_range"},
      {"P\r", "incomplete_command"},
      {"P+3", "incomplete_command unknown_byte unknown_byte"},
      {"PR3", "incomplete_command R3"},
      {"PE+5\r", "incomplete_command E+5"},
      {"P\rE+5\r", "incomplete_command E+5"},
      {"LLMM", "L L M M"},
  });
}

TEST(RhinoParser, EnvironmentCommands) {
  expect_rows_in_both_profiles({
      {"A#", "A#"},
      {"A$", "A$"},
      {"A@", "A@"},
      {"A|", "A|"},
      {"A #", "A#"},
      {"A#A#", "A# A#"},
      {"E#", "unknown_byte"},
      {"#", "unknown_byte"},
      {"$@|", "unknown_byte unknown_byte unknown_byte"},
      {"!*.%", "unknown_byte unknown_byte unknown_byte unknown_byte"},
      {"A\r$", "unknown_byte"},
      {"A$$", "A$ unknown_byte"},
      {"A&", "unknown_byte"},
  });
}

TEST(RhinoParser, ViewVectors) {
  expect_rows_in_both_profiles({
      {"A!1,2,3!", "A!1,2,3!"},
      {"A!-9,0,+9!", "A!-9,0,9!"},
      {"A! 1 , 2 , 3 !", "A!1,2,3!"},
      {"A!- 1,2,3!", "A!-1,2,3!"},
      {"A!!", "A!1,1,1!"},
      {"A! !", "A!1,1,1!"},
      {"A!0,0,1!", "A!0,0,1!"},
      {"A!0,0,0!", "bad_view_vector"},
      {"A!10,0,0!", "bad_view_vector"},
      {"A!0,-10,0!", "bad_view_vector"},
      {"A!1!", "bad_view_vector"},
      {"A!1,2!", "bad_view_vector"},
      {"A!1,2,!", "bad_view_vector"},
      {"A!,,!", "bad_view_vector"},
      {"A!1,2,3,4!", "bad_view_vector"},
      {"A!1 2,3,4!", "bad_view_vector"},
      {"A!--1,2,3!", "bad_view_vector"},
      {"A!1-,2,3!", "bad_view_vector"},
      {"A!+!", "bad_view_vector"},
      {"A!99999999999,1,1!", "bad_view_vector"},
      {"A!1\r", "incomplete_command"},
      {"A!1,2,3\rE+5\r", "incomplete_command E+5"},
      {"A!\n", "incomplete_command"},
      {"A!1,E+5\r", "bad_view_vector E+5"},
      {"A!1,2,3!A!!", "A!1,2,3! A!1,1,1!"},
  });
}

TEST(RhinoParser, RefreshPeriods) {
  expect_rows_in_both_profiles({
      {"A.1\r", "A.1"},
      {"A.255 ", "A.255"},
      {"A. 12\r", "A.12"},
      {"A.12", ""},
      {"A.6E+5\r", "A.6 E+5"},
      {"A.6.", "A.6 unknown_byte"},
      {"A.0\r", "number_out_of_range"},
      {"A.256\r", "number_out_of_range"},
      {"A.\r", "incomplete_command"},
      {"A.+5\r", "incomplete_command unknown_byte unknown_byte"},
      {"A.E+5\r", "incomplete_command E+5"},
  });
}

TEST(RhinoParser, StatusLineOptions) {
  for (int option = 0; option <= 6; ++option) {
    const std::string bytes = "A%" + std::to_string(option);
    EXPECT_EQ(words(parse(bytes)), bytes);
  }
  expect_rows_in_both_profiles({
      {"A% 3", "A%3"},
      {"A%7", "number_out_of_range"},
      {"A%9", "number_out_of_range"},
      {"A%\r", "incomplete_command"},
      {"A%-1", "incomplete_command unknown_byte unknown_byte"},
      {"A%12", "A%1 no_joint_selected"},
  });
}

TEST(RhinoParser, CameraInquiries) {
  expect_rows_in_both_profiles({
      {"A**", "A**"},
      {"A* *", "A**"},
      {"A*0*", "A*0*"},
      {"A*191*", "A*191*"},
      {"A*3,4*", "A*3,4*"},
      {"A* 3 , 4 *", "A*3,4*"},
      {"A*3,*", "bad_camera_argument"},
      {"A*,4*", "bad_camera_argument"},
      {"A*,*", "bad_camera_argument"},
      {"A*1,2,3*", "bad_camera_argument"},
      {"A*-1*", "bad_camera_argument"},
      {"A*+1*", "bad_camera_argument"},
      {"A*1 2*", "bad_camera_argument"},
      {"A*3\r", "incomplete_command"},
      {"A*3\r*", "incomplete_command unknown_byte"},
      {"A*3E+5\r", "bad_camera_argument E+5"},
      {"A***", "A** unknown_byte"},
      {"A**A*0*", "A** A*0*"},
  });
}

// --- Where a command or problem came from.

struct PlaceRow {
  std::string_view bytes;
  std::size_t item;  ///< which of those parsed
  std::uint64_t from;
  std::uint64_t to;
  std::string_view raw;
};

TEST(RhinoParser, EachItemHasItsBytes) {
  const PlaceRow rows[] = {
      {"E+5\r", 0, 0, 4, "E+5\r"},
      {"E+5C-3\r", 0, 0, 3, "E+5"},
      {"E+5C-3\r", 1, 3, 7, "C-3\r"},
      {"E+5X", 0, 0, 3, "E+5"},
      {"E+5X", 1, 3, 4, "X"},
      {"E??", 0, 0, 2, "E?"},
      {"E??", 1, 2, 3, "?"},
      {"\r\nE60S", 0, 2, 6, "E60S"},
      {"E+200\r", 0, 0, 6, "E+200\r"},
      {"E 5 ", 0, 0, 4, "E 5 "},
      {"EZ5\r", 0, 1, 2, "Z"},
      {"EZ5\r", 1, 2, 3, "5"},
      {"I", 0, 0, 1, "I"},
      {"AI", 0, 0, 2, "AI"},
      {"E+5\r\nA!0,0,0!", 1, 5, 13, "A!0,0,0!"},
      {"A*3\rE+5\r", 0, 0, 3, "A*3"},
      {"A*3\rE+5\r", 1, 4, 8, "E+5\r"},
      {"P\rQ", 0, 0, 1, "P"},
      {"P\rQ", 1, 2, 3, "Q"},
      {"E--5", 0, 0, 2, "E-"},
      {"E--5", 1, 2, 3, "-"},
      {"E+2.5", 1, 3, 4, "."},
      {"A+2.5 ", 2, 3, 6, ".5 "},
      {"\r\nhelp\r", 2, 2, 7, "help\r"},
      {"?", 0, 0, 1, "?"},
      {"ECE+5\r", 0, 2, 6, "E+5\r"},
      {"\xff", 0, 0, 1, "\xff"},
  };
  for (const PlaceRow& row : rows) {
    const auto parsed = parse(row.bytes);
    ASSERT_GT(parsed.size(), row.item) << readable(row.bytes);
    const Parsed& item = parsed[row.item];
    EXPECT_EQ(item.from, row.from) << readable(row.bytes) << ", item " << row.item;
    EXPECT_EQ(item.to, row.to) << readable(row.bytes) << ", item " << row.item;
    EXPECT_EQ(item.raw.view(), row.raw) << readable(row.bytes) << ", item " << row.item;
    EXPECT_FALSE(item.raw.was_cut);
  }
}

TEST(RhinoParser, KeepsTheFirstBytesOfALongNumber) {
  const std::string bytes = "E" + std::string(1'000'000, '9') + "\r";
  const auto parsed = parse(bytes);
  ASSERT_EQ(parsed.size(), 1U);
  EXPECT_EQ(parsed[0].raw.view(), std::string_view(bytes).substr(0, RawBytes::kMax));
  EXPECT_TRUE(parsed[0].raw.was_cut);
  EXPECT_EQ(parsed[0].from, 0U);
  EXPECT_EQ(parsed[0].to, bytes.size());
}

struct SubjectRow {
  std::string_view bytes;
  Problem problem;
};

TEST(RhinoParser, AProblemNamesTheIntendedCommand) {
  const SubjectRow rows[] = {
      {"E+200\r", {ProblemCode::kNumberOutOfRange, Subject::kMove}},
      {"E300S", {ProblemCode::kSpeedOutOfRange, Subject::kSpeed}},
      {"P9", {ProblemCode::kNumberOutOfRange, Subject::kOutput}},
      {"A.0\r", {ProblemCode::kNumberOutOfRange, Subject::kPeriod}},
      {"A%7", {ProblemCode::kNumberOutOfRange, Subject::kStatus}},
      {"E+\r", {ProblemCode::kIncompleteCommand, Subject::kMove}},
      {"P\r", {ProblemCode::kIncompleteCommand, Subject::kOutput}},
      {"R\r", {ProblemCode::kIncompleteCommand, Subject::kOutput}},
      {"A!1\r", {ProblemCode::kIncompleteCommand, Subject::kView}},
      {"A*3\r", {ProblemCode::kIncompleteCommand, Subject::kCamera}},
      {"A.\r", {ProblemCode::kIncompleteCommand, Subject::kPeriod}},
      {"A%\r", {ProblemCode::kIncompleteCommand, Subject::kStatus}},
      {"ES", {ProblemCode::kUnknownByte, Subject::kSpeed}},
      {"S", {ProblemCode::kNoJointSelected, Subject::kSpeed}},
      {"5", {ProblemCode::kNoJointSelected, Subject::kMove}},
      {"?", {ProblemCode::kNoJointSelected, Subject::kNone}},
      {"Z", {ProblemCode::kUnknownByte, Subject::kNone}},
  };
  for (const SubjectRow& row : rows) {
    const auto parsed = parse(row.bytes);
    ASSERT_EQ(parsed.size(), 1U) << readable(row.bytes);
    EXPECT_EQ(std::get<Problem>(parsed[0].what), row.problem) << readable(row.bytes);
  }
  const auto skipped = parse("EZ5");
  EXPECT_EQ(std::get<Problem>(skipped.at(1).what),
            (Problem{ProblemCode::kUnknownByte, Subject::kSkippedNumber}));
}

// --- Disabled.

std::vector<Parsed> parse_disabled(std::string_view before, std::string_view bytes) {
  RhinoParser parser(Profile::kPaper);
  std::vector<Parsed> parsed;
  std::uint64_t offset = 0;
  for (const char byte : before) parser.feed(static_cast<std::uint8_t>(byte), offset++, parsed);
  parsed.clear();
  for (const char byte : bytes)
    parser.feed_disabled(static_cast<std::uint8_t>(byte), offset++, parsed);
  return parsed;
}

struct DisabledRow {
  std::string_view before;  ///< sent while enabled
  std::string_view bytes;
  std::string_view meaning;  ///< items with a blank between them
};

TEST(RhinoParser, WhileDisabledAcceptsOnlyTheEnablingCommand) {
  const DisabledRow rows[] = {
      {"", "A@", "A@"},
      {"", "a@", "A@"},
      {"", "A @", "A@"},
      {"A", "@", "A@"},
      {"", "A\r@", "disabled"},
      {"", "@", "disabled"},
      {"", "E?", "disabled disabled"},
      {"", "AI", "disabled"},
      {"", "A?@", "disabled disabled"},
      {"", "AA@", "A@"},
      {"", "EA@", "disabled A@"},
      {"", "\r\n \r\n", ""},
      {"E+5", "\r", ""},
      {"E+5", "A@", "A@"},
      {"A+5", "@", "disabled"},
      {"A+", "@", "disabled"},
      {"A+", " @", "disabled"},
      {"A+5 ", "@", "A@"},
      {"A*3", "*", "disabled"},
      {"A*3", "A@", "A@"},
      {"P", "3", "disabled"},
      {"hel", "p\r", "disabled"},
  };
  for (const DisabledRow& row : rows) {
    EXPECT_EQ(words(parse_disabled(row.before, row.bytes)), row.meaning)
        << readable(row.before) << " then, disabled, " << readable(row.bytes);
  }
}

TEST(RhinoParser, DisablingDiscardsAnIncompleteCommand) {
  RhinoParser parser(Profile::kPaper);
  std::vector<Parsed> parsed;
  for (const char byte : "E+5"sv) parser.feed(static_cast<std::uint8_t>(byte), 0, parsed);
  parser.feed_disabled('I', 3, parsed);
  for (const char byte : "9\r"sv) parser.feed(static_cast<std::uint8_t>(byte), 4, parsed);
  EXPECT_EQ(words(parsed), "disabled no_joint_selected");
}

TEST(RhinoParser, DisablingDiscardsAnIncompleteCommandAlsoAtABlank) {
  RhinoParser parser(Profile::kPaper);
  std::vector<Parsed> parsed;
  for (const char byte : "A+5"sv) parser.feed(static_cast<std::uint8_t>(byte), 0, parsed);
  parser.feed_disabled(' ', 3, parsed);
  parser.feed('\r', 4, parsed);
  EXPECT_EQ(words(parsed), "");
}

// --- Everything there is.

using Parsers = std::vector<RhinoParser>;

bool is_as_new_after_a_carriage_return(RhinoParser parser, Profile profile,
                                       std::vector<Parsed>& out) {
  out.clear();
  parser.feed('\r', 3, out);
  return out.size() <= 3 && parser == RhinoParser(profile);
}

// Feeds every byte to every parser. Returns the different parsers that result.
Parsers fed_every_byte(const Parsers& parsers, std::uint64_t offset, Profile profile) {
  Parsers result;
  std::vector<Parsed> out;
  for (const RhinoParser& before : parsers) {
    for (unsigned byte = 0; byte < 256; ++byte) {
      RhinoParser parser = before;
      out.clear();
      parser.feed(static_cast<std::uint8_t>(byte), offset, out);
      EXPECT_LE(out.size(), 3U) << byte;
      EXPECT_TRUE(is_as_new_after_a_carriage_return(parser, profile, out)) << byte;
      if (std::find(result.begin(), result.end(), parser) == result.end()) result.push_back(parser);
    }
  }
  return result;
}

// A parser that equals a new one after a CR accepts any input, so this proves more than that E+5
// moves E. Equal parsers behave alike: only different ones go on to the next byte.
void expect_every_three_bytes_are_bounded(Profile profile) {
  Parsers parsers{RhinoParser(profile)};
  for (std::uint64_t offset = 0; offset < 3; ++offset)
    parsers = fed_every_byte(parsers, offset, profile);
  EXPECT_GT(parsers.size(), 1000U);
}

TEST(RhinoParser, AcceptsEveryThreeBytesInThePaperProfile) {
  expect_every_three_bytes_are_bounded(Profile::kPaper);
}

TEST(RhinoParser, AcceptsEveryThreeBytesInTheMark3Profile) {
  expect_every_three_bytes_are_bounded(Profile::kMark3);
}

TEST(RhinoParser, AMoveWorksAfterAnyTwoBytesAndACr) {
  for (unsigned first = 0; first < 256; ++first) {
    for (unsigned second = 0; second < 256; ++second) {
      const std::string bytes{static_cast<char>(first), static_cast<char>(second)};
      const auto parsed = parse(bytes + "\rE+5\r");
      ASSERT_FALSE(parsed.empty());
      ASSERT_EQ(words(parsed.back()), "E+5") << readable(bytes);
    }
  }
}

TEST(RhinoParser, IsSmall) { EXPECT_LE(sizeof(RhinoParser), 96U); }

}  // namespace
}  // namespace xr3
