// Which of the goals that a run has met count.
#include "protocol/goals/credit.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

/// A run with two goals of two points, both met, of which the first is passive.
struct CreditedRun {
  std::vector<GoalResult> results{{true, 2, "no_stall", "", "", ""},
                                  {true, 2, "joint", "", "", ""}};
  std::vector<bool> passive{true, false};
  RunOutcome outcome = RunOutcome::kFinished;
  GoalList list;
  RunFacts facts;
  std::string why;

  int points() {
    why = withhold(results, list, passive, outcome, facts);
    return points_of(results);
  }
};

TEST(Credit, APassiveGoalCountsWithOneThatWasReached) {
  CreditedRun run;
  EXPECT_EQ(run.points(), 4);
  EXPECT_EQ(run.why, "");
  run.outcome = RunOutcome::kTimeUp;
  EXPECT_EQ(run.points(), 4);
}

TEST(Credit, PassiveGoalsAloneGiveNothing) {
  CreditedRun run;
  run.results[1].is_met = false;
  run.facts.last_count_tick = 1;
  EXPECT_EQ(run.points(), 0);
  EXPECT_EQ(run.why, "a robot without a program meets them, too, and no other goal is met");
  EXPECT_FALSE(run.results[0].is_counted);
  EXPECT_TRUE(run.results[1].is_counted) << "it is missed, which says enough";
}

TEST(Credit, AProgramThatFailsGetsNothingUnlessTheFileSaysSo) {
  CreditedRun run;
  run.outcome = RunOutcome::kFailed;
  EXPECT_EQ(run.points(), 0);
  EXPECT_EQ(run.why, "the program failed");
  run.list.failed_program_counts = true;
  EXPECT_EQ(run.points(), 4);
  run.results[1].is_met = false;
  EXPECT_EQ(run.points(), 0) << "passive goals alone";
}

TEST(Credit, OnlyPassiveGoalsCountIfTheProgramMovedAndEndedWell) {
  CreditedRun run;
  run.passive = {true, true};
  EXPECT_EQ(run.points(), 0);
  EXPECT_NE(run.why.find("if the program moves the robot"), std::string::npos);
  run.facts.last_count_tick = 1;
  EXPECT_EQ(run.points(), 4);
  run.outcome = RunOutcome::kTimeUp;
  EXPECT_EQ(run.points(), 0);
}

TEST(Credit, NothingIsWithheldIfNothingIsMet) {
  CreditedRun run;
  run.outcome = RunOutcome::kFailed;
  run.results[0].is_met = run.results[1].is_met = false;
  EXPECT_EQ(run.points(), 0);
  EXPECT_EQ(run.why, "");
  run.results.clear();
  run.passive.clear();
  EXPECT_EQ(run.points(), 0);
  EXPECT_EQ(run.why, "");
}

}  // namespace
}  // namespace xr3
