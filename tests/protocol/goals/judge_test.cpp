// Each kind of goal, met and missed, and the sentences about it.
#include "protocol/goals/judge.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "core/home.hpp"
#include "core/kinematics.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using namespace goal;  // NOLINT: the kinds

/// A run of the Rhino, at its start unless it is changed.
struct JudgedRun {
  Model model{test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"), Profile::kPaper};
  State end = initial_state(model);
  RunFacts facts;

  GoalResult result(Condition body, const std::string& hint = "") {
    facts.breaches.resize(1);
    return judge({"", {{1, hint, std::move(body)}}}, model, end, facts).at(0);
  }
  /// The expected and, if it is missed, what was found.
  std::string text(Condition body) {
    const GoalResult each = result(std::move(body));
    EXPECT_EQ(each.is_met, each.found.empty());
    return each.is_met ? each.expected : each.expected + ": " + each.found;
  }
  Block& block(const std::string& name) {
    for (Block& each : end.blocks.edit())
      if (each.name == name) return each;
    throw std::invalid_argument(name);
  }
};

BlockPlace red_at(PartialPoint point) { return {.name = "red", .point = point}; }

TEST(Judge, ABlockAtAPoint) {
  JudgedRun run;
  run.block("red").centroid_um = {262'000, 0, 20'000};
  EXPECT_EQ(run.text(red_at({260'000, 3'000, std::nullopt})),
            "block red at x 260, y 3 mm, within 5 mm");
  EXPECT_EQ(run.text(red_at({400'000, {}, 20'000})),
            "block red at x 400, z 20 mm, within 5 mm: it is at x 262, y 0, z 20 mm, 138 mm away");
}

TEST(Judge, ADistanceOfExactlyTheToleranceIsEnough) {
  JudgedRun run;
  run.block("red").centroid_um = {105'000, 0, 0};
  EXPECT_TRUE(run.result(red_at({100'000, 0, 0})).is_met);
  run.block("red").centroid_um = {105'001, 0, 0};
  EXPECT_FALSE(run.result(red_at({100'000, 0, 0})).is_met);
}

TEST(Judge, YawsAreModuloAHalfTurnOrAQuarterForASquare) {
  JudgedRun run;
  Block& red = run.block("red");
  BlockPlace goal{.name = "red", .yaw_udeg = 90'000'000};
  red.size_um = {60'000, 30'000, 40'000};
  red.yaw_udeg = -92'000'000;
  EXPECT_EQ(run.text(goal), "block red, yaw 90 degrees, within 5");
  red.yaw_udeg = 0;
  EXPECT_EQ(run.text(goal), "block red, yaw 90 degrees, within 5: its yaw is 0 degrees");
  red.size_um.y = red.size_um.x;
  EXPECT_TRUE(run.result(goal).is_met);
}

TEST(Judge, ABlockInABoxOrBesideAnother) {
  JudgedRun run;
  run.block("red").centroid_um = {300'000, 10'000, 20'000};
  const BoxUm box{{200'000, 0, 0}, {300'000, 50'000, 40'000}};
  EXPECT_TRUE(run.result(BlockPlace{.name = "red", .box = box}).is_met) << "the edge is inside";
  run.block("red").centroid_um.y = -1;
  EXPECT_EQ(
      run.text(BlockPlace{.name = "red", .box = box}),
      "block red in the box x 200 to 300, y 0 to 50, z 0 to 40 mm: it is at x 300, y 0, z 20 mm");
  run.block("green").centroid_um = {300'000, 50'000, 20'000};
  EXPECT_TRUE(
      run.result(BlockPlace{.name = "red", .at = "green", .offset = {0, -50'000, {}}}).is_met);
  EXPECT_FALSE(
      run.result(BlockPlace{.name = "red", .at = "green", .offset = {0, 50'000, {}}}).is_met);
  EXPECT_FALSE(run.result(BlockPlace{.name = "red", .at = "green"}).is_met);
}

TEST(Judge, AHeldBlockFailsUnlessItMayBeHeld) {
  JudgedRun run;
  run.end.held = Held{0, 0, positions(run.model, run.end.motors)};
  BlockPlace goal{.name = run.end.blocks[0].name, .point = PartialPoint{{}, {}, {}}};
  const GoalResult missed = run.result(goal);
  EXPECT_EQ(missed.found, "the jaws hold it");
  EXPECT_EQ(missed.hint, "open the jaws before the program ends");
  EXPECT_EQ(run.result(goal, "my hint").hint, "my hint");
  goal.may_be_held = true;
  EXPECT_TRUE(run.result(goal).is_met);
  EXPECT_TRUE(run.result(Holding{goal.name}).is_met);
  EXPECT_EQ(run.text(Holding{}), "the jaws hold nothing: they hold " + goal.name);
}

TEST(Judge, AStackRestsOnItsBlock) {
  JudgedRun run;
  const Block& blue = run.block("blue");
  Block& red = run.block("red");
  red.centroid_um = blue.centroid_um;
  red.centroid_um.z += (red.size_um.z + blue.size_um.z) / 2;
  EXPECT_TRUE(run.result(Stacked{"red", "blue"}).is_met);
  red.centroid_um.z += 3'000;
  EXPECT_NE(run.text(Stacked{"red", "blue"}).find("the gap is 3 mm"), std::string::npos);
  red.centroid_um.x += 200'000;
  EXPECT_FALSE(run.result(Stacked{"red", "blue"}).is_met);
}

TEST(Judge, BlocksInOrder) {
  JudgedRun run;
  run.block("red").centroid_um.x = 100;
  run.block("green").centroid_um.x = 200;
  run.block("red").color = 3;
  run.block("green").color = 5;
  const Sorted goal{{"red", "green"}, SortKey::kColor, SortAxis::kX};
  EXPECT_TRUE(run.result(goal).is_met);
  EXPECT_EQ(run.text(Sorted{{"red", "green"}, SortKey::kColor, SortAxis::kMinusX}),
            "red and green sorted by color along -x: block green comes before block red");
}

TEST(Judge, AJointByValueOrCount) {
  JudgedRun run;
  EXPECT_TRUE(run.result(JointValue{'E', -90.0, {}, 0}).is_met);
  EXPECT_EQ(run.text(JointValue{'E', 0.0, {}, 2}),
            "joint E at 0 degrees, within 2: it is at -90 degrees");
  EXPECT_EQ(run.text(JointValue{'E', {}, 3, 0}),
            "joint E at 3 counts, within 0: it is at 0 counts");
}

TEST(Judge, TheTip) {
  JudgedRun run;
  const PointUm tip = tool_tip(run.model, positions(run.model, run.end.motors));
  EXPECT_TRUE(run.result(TipPlace{{tip.x, {}, tip.z}}).is_met);
  EXPECT_FALSE(run.result(TipPlace{{tip.x + 6'000, {}, {}}}).is_met);
}

TEST(Judge, FactsOfTheWholeRun) {
  JudgedRun run;
  EXPECT_TRUE(run.result(NoStall{}).is_met);
  EXPECT_TRUE(run.result(NoWarnings{}).is_met);
  EXPECT_TRUE(run.result(MaxBytes{0}).is_met);
  run.facts.stall = Stall::kProtectedRegion;
  run.facts.stall_tick = 1'250;
  run.facts.problems = {{300, "unknown_command", "x is no command", 2}};
  run.facts.problem_count = 2;
  run.facts.bytes = 12;
  run.facts.last_count_tick = 2'001;
  run.facts.tip_path_um = 10'000;
  EXPECT_EQ(
      run.text(NoStall{}),
      "the robot never stalls: it stalled after 1.25 s: the tool tip entered the protected region");
  EXPECT_EQ(run.text(NoWarnings{}),
            "no warnings: 2 warnings, first x is no command (unknown_command) after 0.3 s");
  run.facts.problems.push_back({400, "counter_overflow", "", 1});
  run.facts.problems.push_back({400, "byte_clock_hurry", "", 1});
  EXPECT_EQ(run.text(NoWarnings{}),
            "no warnings: 2 warnings, first x is no command (unknown_command) after 0.3 s; then "
            "counter_overflow, byte_clock_hurry");
  EXPECT_TRUE(run.result(NoSoftHome{}).is_met);
  run.facts.soft_home_tick = 7'000;
  EXPECT_EQ(run.text(NoSoftHome{}),
            "the controller's soft home (A$) is not used: it was used after 7 s");
  EXPECT_EQ(run.text(MaxBytes{11}), "at most 11 bytes sent: 12 bytes were sent");
  EXPECT_EQ(run.text(MaxSimTime{2'000}),
            "the last motion after at most 2 simulated s: it was after 2.001 s");
  EXPECT_TRUE(run.result(MaxSimTime{2'001}).is_met);
  EXPECT_EQ(run.text(MaxTipPath{9'000}), "the tool tip moves at most 9 mm: it moved 10 mm");
}

TEST(Judge, BreachesOfTheWholeRun) {
  JudgedRun run;
  run.facts.breaches = {Breach{2'000, "blue", {}}};
  EXPECT_EQ(run.text(Untouched{{"blue"}}),
            "blue not moved by more than 1 mm: block blue was moved after 2 s");
  run.facts.breaches = {Breach{2'000, "", {1'000, 2'000, 3'000}}};
  EXPECT_EQ(run.text(KeepOut{{{0, 0, 0}, {5'000, 5'000, 5'000}}}),
            "tool tip never in the box x 0 to 5, y 0 to 5, z 0 to 5 mm: "
            "it was at x 1, y 2, z 3 mm after 2 s");
}

TEST(Judge, AnOrderIsASubsequence) {
  JudgedRun run;
  run.facts.happenings = {"grasped red", "released red", "grasped blue", "released blue"};
  EXPECT_TRUE(run.result(Order{{"grasped red", "released blue"}}).is_met);
  EXPECT_EQ(run.text(Order{{"grasped blue", "grasped red"}}),
            "in this order: grasped blue and grasped red: \"grasped red\" did not happen, or not "
            "after what comes before it");
}

TEST(Judge, PointsAreCounted) {
  JudgedRun run;
  run.facts.breaches.resize(2);
  const auto results =
      judge({"", {{3, "", NoStall{}}, {4, "", Holding{"red"}}}}, run.model, run.end, run.facts);
  EXPECT_EQ(points_of(results), 3);
  EXPECT_EQ(max_points_of(results), 7);
}

}  // namespace
}  // namespace xr3
