#include "server/cells/live_goals.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using monitor::CellSummary;

/// A cell whose goals are: no stall (a robot at rest meets it), and E at count 50.
struct GoalCell {
  GoalCell() {
    GoalList goals;
    goals.goals.push_back({.body = goal::NoStall{}});
    goals.goals.push_back({.body = goal::JointValue{.label = 'E', .count = 50}});
    live.emplace(cell, std::make_shared<const LiveExercise>(
                           live_exercise("Fifty", std::move(goals), cell.model_ptr(), {})));
    cell.apply(LineOpened{"test"}, 0);
  }
  CellSummary summary() const {
    CellSummary summary;
    live->describe(summary);
    return summary;
  }
  void apply(const call::Call& call) {
    cell.apply(Input{call}, 0);
    live->update();
  }

  Cell cell{"main", test::rhino(), SimClock::manual()};
  std::optional<LiveGoals> live;
};

TEST(LiveGoals, AreMetWhileTheRobotMoves) {
  GoalCell one;
  EXPECT_EQ(one.summary().goals, (std::vector<bool>{false, false}))
      << "what a robot at rest meets counts with another goal";
  EXPECT_EQ(one.summary().points, (monitor::PointsSummary{0, 2}));
  one.cell.apply(BytesIn{1, "E+50\r"}, 0);
  one.apply(call::RunUntil{std::nullopt, 10'000});
  EXPECT_EQ(one.summary().goals, (std::vector<bool>{true, true}));
  EXPECT_EQ(one.summary().points, (monitor::PointsSummary{2, 2}));
}

TEST(LiveGoals, BeginAnewWithAReset) {
  GoalCell one;
  one.cell.apply(BytesIn{1, "E+50\r"}, 0);
  one.apply(call::RunUntil{std::nullopt, 10'000});
  one.apply(call::Reset{});
  EXPECT_EQ(one.summary().points, (monitor::PointsSummary{0, 2}));
}

TEST(LiveGoals, HaveSentences) {
  const GoalCell one;
  ASSERT_EQ(one.live->exercise().sentences.size(), 2U);
  EXPECT_NE(one.live->exercise().sentences[1].find("50"), std::string::npos)
      << one.live->exercise().sentences[1];
}

}  // namespace
}  // namespace xr3
