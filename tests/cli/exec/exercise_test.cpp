#include "cli/exec/exercise.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

TEST(ExerciseReport, IsThatOfTheRun) {
  RunReport report;
  report.program = "ada.py";
  EXPECT_EQ(report_of(to_json(report), "ada.py").outcome, RunOutcome::kFinished);
}

TEST(ExerciseReport, FailsAloneIfThereIsNone) {
  for (const std::optional<std::string>& text :
       {std::optional<std::string>(), std::optional<std::string>("{\"poi"),
        std::optional<std::string>("{}"), std::optional<std::string>("[1]")}) {
    const RunReport report = report_of(text, "bob.py");
    EXPECT_EQ(report.program, "bob.py");
    EXPECT_EQ(report.outcome, RunOutcome::kFailed);
  }
}

}  // namespace
}  // namespace xr3
