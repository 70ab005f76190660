// Exercise files as values.
#include "protocol/files/exercise.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/check/check_report.hpp"

namespace xr3 {
namespace {

const std::string kExercise = R"({
  "title": "Stack",
  "notes": "Two blocks.",
  "robot": "adept-one",
  "workcell": "workcell.json",
  "faults": "worn-arm",
  "clock": "bytes:200",
  "vary": "7:40",
  "goals": "goals.json"
})";

TEST(Exercise, IsReadWithAllItsMembers) {
  const ExerciseFile file = load_exercise(kExercise, "e.json");
  EXPECT_EQ(file.title, "Stack");
  EXPECT_EQ(file.robot, "adept-one");
  EXPECT_EQ(file.workcell, "workcell.json");
  EXPECT_EQ(file.faults, "worn-arm");
  EXPECT_EQ(file.clock, "bytes:200");
  EXPECT_EQ(file.vary, "7:40");
  EXPECT_EQ(file.goals, "goals.json");
}

TEST(Exercise, NeedsATitleAndGoals) {
  const auto reading = read_exercise(R"({"title": "Stack", "goals": "stack"})", "e.json");
  ASSERT_TRUE(reading.value);
  EXPECT_EQ(reading.value->clock, "") << "the default of the option";
  EXPECT_EQ(read_exercise(R"({"title": "Stack"})", "e.json").findings.size(), 1U);
}

TEST(Exercise, IsToldFromAGoalsFileByItsTitle) {
  const CheckResult result = check_text(kExercise, "e.json", Profile::kPaper);
  EXPECT_EQ(result.kind, DataKind::kExercise);
  EXPECT_EQ(result.summary,
            "Stack\nTwo blocks.\n  robot adept-one\n  workcell workcell.json\n  faults worn-arm\n"
            "  clock bytes:200\n  vary 7:40\n  goals goals.json\n");
  EXPECT_THROW(load_exercise(R"({"goals": []})", "goals.json"), DataError);
}

}  // namespace
}  // namespace xr3
