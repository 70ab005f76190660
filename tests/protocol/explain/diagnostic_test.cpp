// Diagnostics: stable codes, and sentences that name the bytes.
#include "protocol/explain/diagnostic.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;

constexpr ProblemCode kProblems[] = {
    ProblemCode::kUnknownByte,       ProblemCode::kNumberOutOfRange,
    ProblemCode::kSpeedOutOfRange,   ProblemCode::kNoJointSelected,
    ProblemCode::kIncompleteCommand, ProblemCode::kBadViewVector,
    ProblemCode::kBadCameraArgument, ProblemCode::kDisabled,
    ProblemCode::kDecimalPoint,      ProblemCode::kWord};
constexpr Subject kSubjects[] = {Subject::kNone,   Subject::kMove,      Subject::kSpeed,
                                 Subject::kOutput, Subject::kView,      Subject::kCamera,
                                 Subject::kPeriod, Subject::kStatus,    Subject::kSkippedNumber,
                                 Subject::kHelp,   Subject::kLeaving,   Subject::kStopping,
                                 Subject::kHoming, Subject::kResetting, Subject::kJaws};

TEST(Diagnostic, CodesAreStable) {
  EXPECT_EQ(code_of(ProblemCode::kUnknownByte), "unknown_byte");
  EXPECT_EQ(code_of(ProblemCode::kNumberOutOfRange), "number_out_of_range");
  EXPECT_EQ(code_of(ProblemCode::kSpeedOutOfRange), "speed_out_of_range");
  EXPECT_EQ(code_of(ProblemCode::kNoJointSelected), "no_joint_selected");
  EXPECT_EQ(code_of(ProblemCode::kIncompleteCommand), "incomplete_command");
  EXPECT_EQ(code_of(ProblemCode::kBadViewVector), "bad_view_vector");
  EXPECT_EQ(code_of(ProblemCode::kBadCameraArgument), "bad_camera_argument");
  EXPECT_EQ(code_of(ProblemCode::kDisabled), "disabled");
  EXPECT_EQ(code_of(ProblemCode::kNotForDevice), "not_for_device");
  EXPECT_EQ(code_of(ProblemCode::kDecimalPoint), "decimal_point");
  EXPECT_EQ(code_of(ProblemCode::kWord), "word");
  EXPECT_EQ(code_of(WarningCode::kCounterOverflow), "counter_overflow");
  EXPECT_EQ(code_of(WarningCode::kNoSuchJoint), "no_such_joint");
  EXPECT_EQ(code_of(WarningCode::kBadCameraArgument), "bad_camera_argument");
  EXPECT_EQ(code_of(WarningCode::kJawsTooNarrow), "jaws_too_narrow");
  EXPECT_EQ(code_of(WarningCode::kJawsTouch), "jaws_touch");
  EXPECT_EQ(code_of(WarningCode::kBelowSurface), "below_surface");
  EXPECT_EQ(code_of(WarningCode::kReleasedInAir), "released_in_air");
  EXPECT_EQ(code_of(WarningCode::kBlocksOverlap), "blocks_overlap");
}

TEST(Diagnostic, EveryByteHasAReadableForm) {
  const std::pair<std::string_view, std::string_view> rows[] = {
      {"E+5\r\n", "E+5\\r\\n"},
      {"\0"sv, "\\0"},
      {"\x1b[A", "\\x1b[A"},
      {"\xff\x80", "\\xff\\x80"},
      {"a\\b", "a\\\\b"},
      {"~ \x7f", "~ \\x7f"},
      {"", ""},
  };
  for (const auto& [bytes, text] : rows) EXPECT_EQ(readable(bytes), text);
  std::set<std::string> texts;
  for (int byte = 0; byte < 256; ++byte)
    texts.insert(readable(std::string(1, static_cast<char>(byte))));
  EXPECT_EQ(texts.size(), 256U);
}

TEST(Diagnostic, HexadecimalHasTwoDigitsPerByte) {
  EXPECT_EQ(hexadecimal("\x00\x0a\xff\x45"sv), "000aff45");
}

Parsed parsed(std::string_view bytes, Problem problem) {
  Parsed item;
  for (const char byte : bytes) item.raw.push(static_cast<std::uint8_t>(byte));
  item.what = problem;
  return item;
}

std::string described(std::string_view bytes, ProblemCode code, Subject subject) {
  const Problem problem{code, subject};
  return describe(parsed(bytes, problem), problem);
}

TEST(Diagnostic, AMessageBeginsWithTheBytes) {
  EXPECT_EQ(described("E+200\r", ProblemCode::kNumberOutOfRange, Subject::kMove),
            "E+200: a move is -128...127 counts; ignored");
  EXPECT_EQ(described("E300S", ProblemCode::kSpeedOutOfRange, Subject::kSpeed),
            "E300S: a speed is 1...255 counts a second; ignored");
  const std::string cut =
      described(std::string(40, '9'), ProblemCode::kUnknownByte, Subject::kNone);
  EXPECT_EQ(cut.substr(0, 26), std::string(RawBytes::kMax, '9') + "...:");
}

TEST(Diagnostic, EveryProblemHasAMessage) {
  for (const ProblemCode code : kProblems) {
    for (const Subject subject : kSubjects) {
      EXPECT_GT(described("x", code, subject).size(), "x: a few words"sv.size())
          << code_of(code) << " " << static_cast<int>(subject);
    }
  }
}

}  // namespace
}  // namespace xr3
