// The goals that a robot meets without a program.
#include "cell/judge/passive.hpp"

#include <gtest/gtest.h>

#include "core/kinematics.hpp"
#include "core/state.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using namespace goal;  // NOLINT: the kinds

TEST(PassiveGoals, DependOnTheRobotAndItsBlocksNotOnTheKind) {
  Workcell workcell = test::workcell_named("rhino-xr3");
  const auto passive = [&](const Condition& body) -> bool {
    const auto model =
        std::make_shared<const Model>(test::robot_named("rhino-xr3"), workcell, Profile::kPaper);
    return passive_goals({"", {{1, "", body}}}, model, {}).at(0);
  };
  EXPECT_TRUE(passive(NoStall{}));
  EXPECT_TRUE(passive(JointValue{'E', {}, 0, 0}));
  EXPECT_FALSE(passive(JointValue{'E', {}, 1, 0}));
  EXPECT_TRUE(passive(KeepOut{{{0, 0, -2}, {1, 1, -1}}}));
  EXPECT_FALSE(passive(KeepOut{{{-1'000'000, -1'000'000, 0}, {1'000'000, 1'000'000, 1'000'000}}}));
  EXPECT_FALSE(passive(Order{{"grasped red"}}));
  const BlockPlace place{.name = "red", .point = PartialPoint{392'000, 60'000, {}}};
  EXPECT_FALSE(passive(place));
  for (Block& each : workcell.blocks.edit())
    if (each.name == "red") each.centroid_um.x = 392'000, each.centroid_um.y = 60'000;
  EXPECT_TRUE(passive(place));
}

TEST(PassiveGoals, AreOneForEachGoalWithFaultsToo) {
  const auto model = std::make_shared<const Model>(
      test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"), Profile::kPaper);
  FaultPlan faults;
  faults.faults.push_back(
      {.name = "slip", .kind = FaultKind::kEncoderSlip, .joint = 'E', .at_tick = 0});
  const GoalList goals{"", {{1, "", NoWarnings{}}, {1, "", Holding{"red"}}}};
  EXPECT_EQ(passive_goals(goals, model, faults), (std::vector<bool>{true, false}));
}

}  // namespace
}  // namespace xr3
