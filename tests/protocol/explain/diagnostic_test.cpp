// Diagnostics: stable codes, and sentences that name the bytes.
#include "protocol/explain/diagnostic.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;

constexpr ProblemCode kProblems[] = {
    ProblemCode::kUnknownByte,       ProblemCode::kNumberOutOfRange,  ProblemCode::kSpeedOutOfRange,
    ProblemCode::kNoJointSelected,   ProblemCode::kIncompleteCommand, ProblemCode::kBadViewVector,
    ProblemCode::kBadCameraArgument, ProblemCode::kDisabled};
constexpr Subject kSubjects[] = {Subject::kNone,   Subject::kMove,   Subject::kSpeed,
                                 Subject::kOutput, Subject::kView,   Subject::kCamera,
                                 Subject::kPeriod, Subject::kStatus, Subject::kSkippedNumber};

TEST(Diagnostic, CodesAreStable) {
  EXPECT_EQ(code_of(ProblemCode::kUnknownByte), "unknown_byte");
  EXPECT_EQ(code_of(ProblemCode::kNumberOutOfRange), "number_out_of_range");
  EXPECT_EQ(code_of(ProblemCode::kSpeedOutOfRange), "speed_out_of_range");
  EXPECT_EQ(code_of(ProblemCode::kNoJointSelected), "no_joint_selected");
  EXPECT_EQ(code_of(ProblemCode::kIncompleteCommand), "incomplete_command");
  EXPECT_EQ(code_of(ProblemCode::kBadViewVector), "bad_view_vector");
  EXPECT_EQ(code_of(ProblemCode::kBadCameraArgument), "bad_camera_argument");
  EXPECT_EQ(code_of(ProblemCode::kDisabled), "disabled");
  EXPECT_EQ(code_of(WarningCode::kCounterOverflow), "counter_overflow");
  EXPECT_EQ(code_of(WarningCode::kNoSuchJoint), "no_such_joint");
  EXPECT_EQ(code_of(WarningCode::kBadCameraArgument), "bad_camera_argument");
  EXPECT_EQ(code_of(WarningCode::kJawsTooNarrow), "jaws_too_narrow");
  EXPECT_EQ(code_of(WarningCode::kBelowSurface), "below_surface");
}

TEST(Diagnostic, EveryByteValueCanBeRead) {
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

TEST(Diagnostic, HexadecimalIsTwoDigitsAByte) {
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

TEST(Diagnostic, ASentenceBeginsWithTheBytes) {
  EXPECT_EQ(described("E+200\r", ProblemCode::kNumberOutOfRange, Subject::kMove),
            "E+200: a move is -128...127 counts; not obeyed");
  EXPECT_EQ(described("E300S", ProblemCode::kSpeedOutOfRange, Subject::kSpeed),
            "E300S: a speed is 1...255 counts a second; not obeyed");
  const std::string cut =
      described(std::string(40, '9'), ProblemCode::kUnknownByte, Subject::kNone);
  EXPECT_EQ(cut.substr(0, 26), std::string(RawBytes::kMax, '9') + "...:");
}

TEST(Diagnostic, EveryProblemHasASentenceWhateverItIsAbout) {
  for (const ProblemCode code : kProblems) {
    for (const Subject subject : kSubjects) {
      EXPECT_GT(described("x", code, subject).size(), "x: a few words"sv.size())
          << code_of(code) << " " << static_cast<int>(subject);
    }
  }
}

struct EventRow {
  EventBody event;
  std::string_view code;
  std::string_view sentence;
};

TEST(Diagnostic, EventsHaveACodeAndASentence) {
  const EventRow rows[] = {
      {MoveTaken{'E', 50, 62}, "move", "E +50: counter 62"},
      {Reached{'E', 12}, "reached", "E has reached its target"},
      {MotorBlocked{'F', Blocked::kLimit, 'F', true, 175, 771, 4}, "limit",
       "F is at its upper limit of 175 deg, 4 counts short"},
      {MotorBlocked{'A', Blocked::kLimit, 'A', false, 0, -64, -7}, "limit",
       "A is at its lower limit of 0 mm, 7 counts short"},
      {MotorBlocked{'E', Blocked::kLimit, 'D', false, -15, 502, 8}, "limit",
       "E is blocked because it would move D past its lower limit of -15 deg, 8 counts short"},
      {SwitchChanged{'C', true, 40}, "switch", "the microswitch of C closed"},
      {SwitchChanged{'C', false, 39}, "switch", "the microswitch of C opened"},
      {Homed{}, "homed", "soft home"},
      {OutputChanged{3, true}, "io", "output 3 is high"},
      {InputChanged{8, false}, "io", "input 8 is low"},
      {AuxiliaryChanged{2, true}, "io", "auxiliary port 2 is on"},
      {EnabledChanged{true}, "enabled", "the simulator is enabled"},
      {Warning{WarningCode::kNoSuchJoint, 'G', 0, 0, {}}, "no_such_joint",
       "G: this robot has no such joint; it has A...F"},
  };
  for (const EventRow& row : rows) {
    EXPECT_EQ(code_of(row.event), row.code);
    EXPECT_EQ(describe(row.event, *test::rhino()), row.sentence);
  }
}

TEST(Diagnostic, AStallSaysWhatSetsTheRobotFree) {
  for (const Stall why : {Stall::kProtectedRegion, Stall::kWorkSurface}) {
    EXPECT_NE(describe(Stalled{why}, *test::rhino()).find("A$"), std::string::npos);
  }
  EXPECT_EQ(code_of(EventBody(Stalled{Stall::kProtectedRegion})), "protected_region");
  EXPECT_EQ(code_of(EventBody(Stalled{Stall::kWorkSurface})), "work_surface");
}

TEST(Diagnostic, AWrapNamesTheMoveAndWhatBecameOfTheCounter) {
  const std::string words =
      describe(Warning{WarningCode::kCounterOverflow, 'E', 100, -56, {}}, *test::rhino());
  EXPECT_NE(words.find("E+100"), std::string::npos) << words;
  EXPECT_NE(words.find("-56"), std::string::npos) << words;
}

}  // namespace
}  // namespace xr3
