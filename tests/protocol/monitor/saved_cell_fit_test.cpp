// Saved cells that were edited by hand. They are refused, with all reasons, if a machine with this
// robot cannot reach the state, so that no machine continues from an impossible state.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/home.hpp"
#include "core/kinematics.hpp"
#include "core/simulation.hpp"
#include "protocol/monitor/saved_cell.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using Strings = std::vector<std::string>;
using test::state_at;

constexpr std::initializer_list<test::LabelledCount> kOverTheTable = {{'E', 449}, {'D', -625}};

SavedCell saved_of(const Model& model, State state) {
  return {"sha256:1", model.workcell(), std::move(state)};
}

SavedCell at_home() { return saved_of(*test::rhino(), initial_state(*test::rhino())); }

std::vector<monitor::Detail> details_of(const SavedCell& saved) {
  return monitor::misfits(*test::rhino(), saved);
}

Strings misfits_of(const SavedCell& saved) {
  Strings pointers;
  for (const monitor::Detail& detail : details_of(saved)) pointers.push_back(detail.pointer);
  return pointers;
}

/// Expects one invalid member, reported with these texts.
void expect_refused(const SavedCell& saved, const std::string& pointer, const Json& found,
                    const std::string& allowed) {
  const auto details = details_of(saved);
  ASSERT_EQ(misfits_of(saved), Strings{pointer});
  EXPECT_EQ(details.front().found, found);
  EXPECT_EQ(details.front().allowed, allowed);
}

TEST(SavedCellFit, HomeFits) { EXPECT_EQ(misfits_of(at_home()), Strings{}); }

// --- Counts.

TEST(SavedCellFit, NoJointIsBeyondItsLimits) {
  const ModelPtr model = test::rhino();
  for (const char label : {'F', 'A'}) {
    const int i = model->index_of(label);
    const MotorModel& motor = model->motor(i);
    SavedCell saved = saved_of(*model, state_at(*model, {{label, motor.high}}));
    EXPECT_EQ(misfits_of(saved), Strings{});
    ++saved.state.motor(i).count;
    EXPECT_EQ(misfits_of(saved), Strings{"/state/motors/" + std::to_string(i) + "/count"});
    saved.state.motor(i).count = motor.low - 1;
    EXPECT_EQ(misfits_of(saved), Strings{"/state/motors/" + std::to_string(i) + "/count"});
  }
}

TEST(SavedCellFit, CouplingCounts) {
  const ModelPtr model = test::roomy_rhino();
  const CoupledJoint coupled = model->driven_by(1).at(1);
  const MotorModel& joint = model->motor(coupled.joint);
  const std::int64_t moved = std::int64_t{coupled.gain} * model->motor(1).high;
  const auto farthest = static_cast<Counts>((moved > 0 ? joint.high : joint.low) - moved);
  SavedCell saved =
      saved_of(*model, state_at(*model, {{model->motor(1).drive.label, model->motor(1).high},
                                         {joint.drive.label, farthest}}));
  EXPECT_TRUE(monitor::misfits(*model, saved).empty());
  saved.state.motor(coupled.joint).count += moved > 0 ? 1 : -1;
  EXPECT_FALSE(monitor::misfits(*model, saved).empty());
}

TEST(SavedCellFit, HugeCountsAreTold) {
  SavedCell saved = at_home();
  for (int i = 0; i < 6; ++i) saved.state.motor(i).count = 1 << 30;
  EXPECT_GE(misfits_of(saved).size(), 3U);
}

TEST(SavedCellFit, MotorsThatTheRobotDoesNotHave) {
  SavedCell saved = at_home();
  saved.state.motor(6).speed = 2;
  saved.state.motor(7).count = 1;
  EXPECT_EQ(misfits_of(saved), (Strings{"/state/motors/6", "/state/motors/7"}));
}

// --- Values derived from counts and error counters.

TEST(SavedCellFit, ASwitchFollowsItsCount) {
  SavedCell saved = at_home();
  saved.state.motor(0).switch_closed = true;
  expect_refused(saved, "/state/motors/0/switch_closed", true, "false: at count 0 it is open");
  saved = saved_of(*test::rhino(), state_at(*test::rhino(), {{'F', 700}}));
  ASSERT_TRUE(saved.state.motor(0).switch_closed);
  saved.state.motor(0).switch_closed = false;
  expect_refused(saved, "/state/motors/0/switch_closed", false, "true: at count 700 it is closed");
}

TEST(SavedCellFit, AMotorThatStandsHasNoPhase) {
  SavedCell saved = at_home();
  saved.state.motor(2).phase = 999;
  expect_refused(saved, "/state/motors/2/phase", 999, "0: it has no counts to go");
  saved.state.motor(2).error = 5;
  EXPECT_EQ(misfits_of(saved), Strings{});
  const MotorModel& base = test::rhino()->motor(0);
  saved = saved_of(*test::rhino(), state_at(*test::rhino(), {{'F', base.high}}));
  saved.state.motor(0).error = 5;
  saved.state.motor(0).blocked = Blocked::kLimit;
  EXPECT_EQ(misfits_of(saved), Strings{});
  saved.state.motor(0).phase = 1;
  expect_refused(saved, "/state/motors/0/phase", 1, "0: it is blocked");
}

TEST(SavedCellFit, AMotorIsBlockedByWhatIsThere) {
  SavedCell saved = at_home();
  saved.state.motor(1).blocked = Blocked::kLimit;
  expect_refused(saved, "/state/motors/1/blocked", "limit", "\"no\": it has no counts to go");
  saved.state.motor(1).error = -3;
  expect_refused(saved, "/state/motors/1/blocked", "limit",
                 "\"no\": nothing is in the way of its next count");
  const MotorModel& base = test::rhino()->motor(0);
  saved = saved_of(*test::rhino(), state_at(*test::rhino(), {{'F', base.high}}));
  saved.state.motor(0).error = 5;
  expect_refused(saved, "/state/motors/0/blocked", "no",
                 "\"limit\": its next count would take a joint past a limit");
}

TEST(SavedCellFit, TheSideOfTheSurfaceIsTheTips) {
  SavedCell saved = at_home();
  saved.state.below_surface = true;
  const PointUm tip = tool_tip(*test::rhino(), {});
  expect_refused(
      saved, "/state/below_surface", true,
      "false: the tip is at z " + std::to_string(tip.z) + " um, the work surface at 0 um");
}

TEST(SavedCellFit, TheSurfaceIsTheSnapshotsOwn) {
  SavedCell saved = at_home();
  saved.workcell.work_surface_um = saved.workcell.workspace.z_um - 1;
  EXPECT_EQ(misfits_of(saved), Strings{"/state/below_surface"});
  saved.state.below_surface = true;
  EXPECT_EQ(misfits_of(saved), Strings{});
}

// --- The protected region.

TEST(SavedCellFit, NoTipIsInTheProtectedRegion) {
  const SavedCell saved = saved_of(*test::rhino(), state_at(*test::rhino(), {{'E', -430}}));
  const auto details = details_of(saved);
  ASSERT_EQ(misfits_of(saved), Strings{"/state/motors"});
  EXPECT_TRUE(details[0].found.get<std::string>().starts_with("the tip at ["));
  EXPECT_EQ(
      details[0].allowed,
      "counts with which the tip is outside the protected region: 100000 um and more from the "
      "base's axis, or at z 340000 um and above");
}

/// The Rhino, stalled after leaning back into its protected region.
SavedCell stalled() {
  test::Rig rig;
  while (rig.state().stall == Stall::kNo) {
    rig.move('E', -100);
    rig.settle();
  }
  return saved_of(rig.model(), rig.state());
}

TEST(SavedCellFit, AStallIsWhereATickLeadsIntoTheRegion) {
  SavedCell saved = stalled();
  EXPECT_EQ(saved.state.stall, Stall::kProtectedRegion);
  EXPECT_EQ(misfits_of(saved), Strings{});
  for (MotorState& motor : saved.state.motors) {
    motor.error = 0;  // as after Q
    motor.phase = 0;
  }
  EXPECT_EQ(misfits_of(saved), Strings{});
  SavedCell home = at_home();
  home.state.stall = Stall::kProtectedRegion;
  expect_refused(home, "/state/stall", "protected_region",
                 "\"no\": no tick from here leads into the protected region");
}

TEST(SavedCellFit, TheSurfaceMayBeAnotherOneSinceTheStall) {
  SavedCell saved = at_home();
  saved.state.stall = Stall::kWorkSurface;
  EXPECT_EQ(misfits_of(saved), Strings{});
  const ModelPtr level = test::model_of(test::odd_arm(1));  // turns about the vertical only
  saved = saved_of(*level, initial_state(*level));
  saved.state.stall = Stall::kWorkSurface;
  const auto details = monitor::misfits(*level, saved);
  ASSERT_EQ(details.size(), 1U);
  EXPECT_EQ(details[0].pointer, "/state/stall");
  EXPECT_EQ(details[0].allowed, "\"no\": no tick from here leads the tip downwards");
}

// --- Held blocks.

/// The Rhino holds "thin", grasped by its length of 30 mm; "wide" is elsewhere.
SavedCell holding() {
  Workcell workcell = test::bare_workcell();
  const PointUm tip = tool_tip(*test::rhino(), test::positions_at(*test::rhino(), kOverTheTable));
  workcell.blocks = {{"thin", {30'000, 20'000, 40'000}, tip, 0, 1},
                     {"wide", {90'000, 80'000, 40'000}, {tip.x, 300'000, tip.z}, 0, 2}};
  test::Rig rig(
      std::make_shared<const Model>(test::robot_named("rhino-xr3"), workcell, Profile::kPaper));
  rig.stand_at(kOverTheTable);
  rig.move('A', -128);
  rig.settle();
  rig.move('C', 30);
  rig.move('F', 33);
  rig.move('B', -20);
  rig.settle();
  EXPECT_TRUE(rig.state().held);
  EXPECT_EQ(rig.motor('A').blocked, Blocked::kBlock);
  return saved_of(rig.model(), rig.state());
}

TEST(SavedCellFit, WhatIsHeldFits) { EXPECT_EQ(misfits_of(holding()), Strings{}); }

TEST(SavedCellFit, TheJawsStandWhereTheyClosed) {
  SavedCell saved = holding();
  const Counts closed = saved.state.motor(5).count;
  saved.state.motor(5).count = 0;
  expect_refused(saved, "/state/motors/5/count", 0,
                 std::to_string(closed) + ": there the jaws closed on the block that they hold");
}

TEST(SavedCellFit, TheJawsOpenedAroundTheBlock) {
  SavedCell saved = holding();
  saved.state.motor(5).count = 0;
  saved.state.held->grasped_at[5] = 0;
  const auto details = details_of(saved);
  ASSERT_EQ(misfits_of(saved), Strings{"/state/held/block"});
  EXPECT_EQ(details[0].found, 0);
  EXPECT_EQ(details[0].allowed,
            "a block for which jaws that stand at 0 leave room, and a "
            "closing count less leaves none; along them \"thin\" is 30000 um");
}

TEST(SavedCellFit, AnotherBlockIsHeld) {
  SavedCell saved = holding();
  saved.state.held->block = 1;
  EXPECT_EQ(misfits_of(saved), (Strings{"/state/blocks/1/centroid_um", "/state/held/block"}));
  saved = holding();
  std::swap(saved.state.blocks[0].size_um, saved.state.blocks[1].size_um);
  EXPECT_EQ(misfits_of(saved), Strings{"/state/held/block"});
  saved = holding();
  saved.state.held->quarter_turns ^= 1;
  EXPECT_EQ(misfits_of(saved), (Strings{"/state/blocks/0/yaw_udeg", "/state/held/block"}));
}

TEST(SavedCellFit, TheHeldBlockLiesAsItWasGrasped) {
  SavedCell saved = holding();
  const PointUm was = saved.state.blocks[0].centroid_um;
  ++saved.state.blocks[0].centroid_um.z;
  expect_refused(saved, "/state/blocks/0/centroid_um", {was.x, was.y, was.z + 1},
                 Json({was.x, was.y, was.z}).dump() + ": there the jaws closed on it");
  saved = holding();
  const Microdegrees yaw = saved.state.blocks[0].yaw_udeg;
  saved.state.blocks[0].yaw_udeg = yaw + 1000;
  expect_refused(saved, "/state/blocks/0/yaw_udeg", yaw + 1000,
                 std::to_string(yaw) + ": so the jaws closed on it");
}

TEST(SavedCellFit, TheGraspWasWithinTheLimits) {
  SavedCell saved = holding();
  saved.state.held->grasped_at[0] = 1 << 30;
  saved.state.held->grasped_at[6] = 1;
  EXPECT_EQ(misfits_of(saved), (Strings{"/state/held/grasped_at/0", "/state/held/grasped_at/6"}));
}

TEST(SavedCellFit, TheGraspWasOutsideTheRegion) {
  SavedCell saved = holding();
  saved.state.held->grasped_at = test::positions_at(*test::rhino(), {{'E', -430}});
  const Strings wrong = misfits_of(saved);
  EXPECT_NE(std::find(wrong.begin(), wrong.end(), "/state/held/grasped_at"), wrong.end());
}

// --- The tip's path.

TEST(SavedCellFit, APathIsKeptWhileErasingIsOff) {
  SavedCell saved = at_home();
  saved.state.tip_path.add({1, 2, 3});
  expect_refused(saved, "/state/tip_path/points", "a list of 1",
                 "an empty list while display/erase is true");
  saved.state.display.erase = false;
  EXPECT_EQ(misfits_of(saved), Strings{});
  saved.state.tip_path = {};
  expect_refused(saved, "/state/tip_path/points", "a list of 0",
                 "the tip's places since display/erase is false, one at least");
}

}  // namespace
}  // namespace xr3
