// Saved cells that were edited by hand. They are refused, with all reasons, if a machine with this
// robot cannot reach the state, so that no machine continues from an impossible state.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/camera.hpp"
#include "core/home.hpp"
#include "core/kinematics.hpp"
#include "core/simulation.hpp"
#include "protocol/monitor/request_error.hpp"
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

SavedCell validated_home() { return saved_of(*test::rhino(), initial_state(*test::rhino())); }

std::vector<monitor::Detail> details_of(const SavedCell& saved) {
  return monitor::validate(*test::rhino(), saved);
}

Strings invalid_pointers(const SavedCell& saved) {
  Strings pointers;
  for (const monitor::Detail& detail : details_of(saved)) pointers.push_back(detail.pointer);
  return pointers;
}

/// Expects one invalid member, reported with these texts.
void expect_refused(const SavedCell& saved, const std::string& pointer, const Json& found,
                    const std::string& allowed) {
  const auto details = details_of(saved);
  ASSERT_EQ(invalid_pointers(saved), Strings{pointer});
  EXPECT_EQ(details.front().found, found);
  EXPECT_EQ(details.front().allowed, allowed);
}

// --- Blocks on the carousel.

SavedCell on_carousel() {
  const Model model(test::robot_named("rhino-xr3-accessories"),
                    test::workcell_named("rhino-xr3-accessories"), Profile::kPaper);
  return saved_of(model, state_at(model, {{'H', 77}}));
}

TEST(SavedCellValidation, ABlockOnTheCarouselIsWhereItsCountPutsIt) {
  const ModelPtr model = test::model_of(test::robot_named("rhino-xr3-accessories"));
  SavedCell saved = on_carousel();
  ASSERT_EQ(saved.state.riders.size(), 2U);
  EXPECT_TRUE(monitor::validate(*model, saved).empty());
  saved.state.blocks.edit()[3].centroid_um.x += 1;
  const auto moved = monitor::validate(*model, saved);
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_EQ(moved[0].pointer, "/state/blocks/3/centroid_um");
  saved.state.riders[0].count = 100'000'000;
  const auto beyond = monitor::validate(*model, saved);
  ASSERT_EQ(beyond.size(), 1U);
  EXPECT_EQ(beyond[0].pointer, "/state/riders/0/count");
  EXPECT_EQ(beyond[0].allowed, "a count -1152000...1152000");
}

TEST(SavedCellValidation, ARobotWithoutACarouselHasNoRiders) {
  SavedCell saved = validated_home();
  saved.state.blocks = test::workcell_named("rhino-xr3").blocks;
  saved.state.riders = {{1, 0, saved.state.blocks[1].centroid_um, 0}};
  expect_refused(saved, "/state/riders/0/count", 0, "no riders: the robot has no carousel");
}

// --- Counts.

TEST(SavedCellValidation, RejectsCountsBeyondTheLimits) {
  const ModelPtr model = test::rhino();
  for (const char label : {'F', 'A'}) {
    const int i = model->index_of(label);
    const MotorModel& motor = model->motor(i);
    SavedCell saved = saved_of(*model, state_at(*model, {{label, motor.high}}));
    EXPECT_EQ(invalid_pointers(saved), Strings{});
    ++saved.state.motor(i).count;
    EXPECT_EQ(invalid_pointers(saved), Strings{"/state/motors/" + std::to_string(i) + "/count"});
    saved.state.motor(i).count = motor.low - 1;
    EXPECT_EQ(invalid_pointers(saved), Strings{"/state/motors/" + std::to_string(i) + "/count"});
  }
}

TEST(SavedCellValidation, ChecksLimitsOfCoupledJoints) {
  const ModelPtr model = test::roomy_rhino();
  const CoupledJoint coupled = model->driven_by(1).at(1);
  const MotorModel& joint = model->motor(coupled.joint);
  const std::int64_t moved = std::int64_t{coupled.gain} * model->motor(1).high;
  const auto farthest = static_cast<Counts>((moved > 0 ? joint.high : joint.low) - moved);
  SavedCell saved =
      saved_of(*model, state_at(*model, {{model->motor(1).drive.label, model->motor(1).high},
                                         {joint.drive.label, farthest}}));
  EXPECT_TRUE(monitor::validate(*model, saved).empty());
  saved.state.motor(coupled.joint).count += moved > 0 ? 1 : -1;
  EXPECT_FALSE(monitor::validate(*model, saved).empty());
}

TEST(SavedCellValidation, ReportsHugeCounts) {
  SavedCell saved = validated_home();
  for (int i = 0; i < 6; ++i) saved.state.motor(i).count = 1 << 30;
  EXPECT_GE(invalid_pointers(saved).size(), 3U);
}

TEST(SavedCellValidation, RejectsMotorsThatTheRobotDoesNotHave) {
  SavedCell saved = validated_home();
  saved.state.motor(6).speed = 2;
  saved.state.motor(7).count = 1;
  EXPECT_EQ(invalid_pointers(saved), (Strings{"/state/motors/6", "/state/motors/7"}));
}

TEST(SavedCellValidation, UsesTheSurfaceOfTheSnapshot) {
  SavedCell saved = validated_home();
  saved.workcell.work_surface_um = saved.workcell.workspace.z_um - 1;
  EXPECT_EQ(invalid_pointers(saved), Strings{"/state/below_surface"});
  saved.state.below_surface = true;
  EXPECT_EQ(invalid_pointers(saved), Strings{});
}

// --- The protected region.

TEST(SavedCellValidation, RejectsATipInTheProtectedRegion) {
  const SavedCell saved = saved_of(*test::rhino(), state_at(*test::rhino(), {{'E', -430}}));
  const auto details = details_of(saved);
  ASSERT_EQ(invalid_pointers(saved), Strings{"/state/motors"});
  EXPECT_TRUE(details[0].found.get<std::string>().starts_with("the tip at ["));
  EXPECT_EQ(details[0].allowed,
            "counts that keep the tip outside the protected region: at least 100000 um from the "
            "base's axis, or at z 340000 um or above");
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

TEST(SavedCellValidation, AcceptsAStallAtTheRegion) {
  SavedCell saved = stalled();
  EXPECT_EQ(saved.state.stall, Stall::kProtectedRegion);
  EXPECT_EQ(invalid_pointers(saved), Strings{});
  for (MotorState& motor : saved.state.motors) {
    motor.error = 0;  // as after Q
    motor.phase = 0;
  }
  EXPECT_EQ(invalid_pointers(saved), Strings{});
}

TEST(SavedCellValidation, AStallAtTheSurfaceNeedsATickThatLowersTheTip) {
  SavedCell saved = validated_home();
  saved.state.stall = Stall::kWorkSurface;
  EXPECT_EQ(invalid_pointers(saved), Strings{});
  const ModelPtr level = test::model_of(test::odd_arm(1));  // turns about the vertical only
  saved = saved_of(*level, initial_state(*level));
  saved.state.stall = Stall::kWorkSurface;
  const auto details = monitor::validate(*level, saved);
  ASSERT_EQ(details.size(), 1U);
  EXPECT_EQ(details[0].pointer, "/state/stall");
  EXPECT_EQ(details[0].allowed, "\"no\": no tick from this state moves the tip downwards");
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
  rig.move('A', 127);
  rig.settle();
  rig.move('C', 30);
  rig.move('F', 33);
  rig.move('B', -20);
  rig.settle();
  EXPECT_TRUE(rig.state().held);
  EXPECT_EQ(rig.motor('A').blocked, Blocked::kBlock);
  return saved_of(rig.model(), rig.state());
}

TEST(SavedCellValidation, TheBlockMustFitTheJawsAtTheGrasp) {
  SavedCell saved = holding();
  saved.state.motor(5).count = 0;
  saved.state.held->grasped_at[5] = 0;
  const auto details = details_of(saved);
  ASSERT_EQ(invalid_pointers(saved), Strings{"/state/held/block"});
  EXPECT_EQ(details[0].found, 0);
  EXPECT_EQ(details[0].allowed,
            "a block that fits between the jaws at 0, but not one closing count further; between "
            "the jaws \"thin\" measures 30000 um");
}

TEST(SavedCellValidation, RejectsAnotherHeldBlock) {
  SavedCell saved = holding();
  saved.state.held->block = 1;
  EXPECT_EQ(invalid_pointers(saved), (Strings{"/state/blocks/1/centroid_um", "/state/held/block"}));
  saved = holding();
  std::vector<Block>& blocks = saved.state.blocks.edit();
  std::swap(blocks[0].size_um, blocks[1].size_um);
  EXPECT_EQ(invalid_pointers(saved), Strings{"/state/held/block"});
  saved = holding();
  saved.state.held->quarter_turns ^= 1;
  EXPECT_EQ(invalid_pointers(saved), (Strings{"/state/blocks/0/yaw_udeg", "/state/held/block"}));
}

TEST(SavedCellValidation, RejectsAGraspBeyondTheLimits) {
  SavedCell saved = holding();
  saved.state.held->grasped_at[0] = 1 << 30;
  saved.state.held->grasped_at[6] = 1;
  EXPECT_EQ(invalid_pointers(saved),
            (Strings{"/state/held/grasped_at/0", "/state/held/grasped_at/6"}));
}

TEST(SavedCellValidation, RejectsAGraspInTheProtectedRegion) {
  SavedCell saved = holding();
  saved.state.held->grasped_at = test::positions_at(*test::rhino(), {{'E', -430}});
  const Strings wrong = invalid_pointers(saved);
  EXPECT_NE(std::find(wrong.begin(), wrong.end(), "/state/held/grasped_at"), wrong.end());
}

// --- Values that follow from others.

/// The base at its upper limit, blocked on the way beyond.
SavedCell at_limit() {
  const Counts high = test::rhino()->motor(0).high;
  SavedCell saved = saved_of(*test::rhino(), state_at(*test::rhino(), {{'F', high}}));
  saved.state.motor(0).error = 5;
  saved.state.motor(0).blocked = Blocked::kLimit;
  return saved;
}

SavedCell edited(const SavedCell& saved, const std::string& pointer, const Json& value) {
  Json json = saved_cell_to_json(saved);
  json.at(Json::json_pointer(pointer)) = value;
  return read_saved_cell(json).value.value();
}

TEST(SavedCellValidation, AcceptsReachableStates) {
  const SavedCell moving = edited(validated_home(), "/state/motors/2/error", 5);
  for (const SavedCell& saved :
       {validated_home(), edited(moving, "/state/motors/2/phase", 999), at_limit(), holding()})
    EXPECT_EQ(invalid_pointers(saved), Strings{});
}

TEST(SavedCellValidation, RejectsValuesThatDoNotFollowFromOthers) {
  const SavedCell home = validated_home();
  const SavedCell moving = edited(home, "/state/motors/1/error", -3);
  const SavedCell limit = at_limit();
  const SavedCell closed = saved_of(*test::rhino(), state_at(*test::rhino(), {{'F', 700}}));
  ASSERT_TRUE(closed.state.motor(0).switch_closed);
  const SavedCell held = holding();
  const PointUm at = held.state.blocks[0].centroid_um;
  const Microdegrees yaw = held.state.blocks[0].yaw_udeg;
  struct Case {
    const SavedCell& saved;
    const char* pointer;
    Json value;
    std::string allowed;
  };
  const Case cases[] = {
      {home, "/state/motors/0/switch_closed", true, "false: at count 0 it is open"},
      {closed, "/state/motors/0/switch_closed", false, "true: at count 700 it is closed"},
      {home, "/state/motors/2/phase", 999, "0: it has no counts to go"},
      {limit, "/state/motors/0/phase", 1, "0: it is blocked"},
      {home, "/state/motors/1/blocked", "limit", "\"no\": it has no counts to go"},
      {moving, "/state/motors/1/blocked", "limit", "\"no\": nothing blocks its next count"},
      {limit, "/state/motors/0/blocked", "no",
       "\"limit\": its next count would take a joint past a limit"},
      {home, "/state/below_surface", true,
       "false: the tip is at z " + std::to_string(tool_tip(*test::rhino(), {}).z) +
           " um, the work surface at 0 um"},
      {home, "/state/stall", "protected_region",
       "\"no\": no tick from this state moves the tip into the protected region"},
      {held, "/state/motors/5/count", 0,
       std::to_string(held.state.motor(5).count) +
           ": the count at which the jaws closed on the block that they hold"},
      {held,
       "/state/blocks/0/centroid_um",
       {at.x, at.y, at.z + 1},
       Json({at.x, at.y, at.z}).dump() + ": its position when the jaws closed on it"},
      {held, "/state/blocks/0/yaw_udeg", yaw + 1000,
       std::to_string(yaw) + ": its yaw when the jaws closed on it"},
  };
  for (const auto& [saved, pointer, value, allowed] : cases)
    expect_refused(edited(saved, pointer, value), pointer, value, allowed);
}

// --- The tip's path.

TEST(SavedCellValidation, ThePathMatchesTheEraseSetting) {
  SavedCell saved = validated_home();
  saved.state.tip_path.add({1, 2, 3});
  expect_refused(saved, "/state/tip_path/points", "a list of 1",
                 "an empty list while display/erase is true");
  saved.state.display.erase = false;
  EXPECT_EQ(invalid_pointers(saved), Strings{});
  saved.state.tip_path = {};
  expect_refused(saved, "/state/tip_path/points", "a list of 0",
                 "at least one position of the tip while display/erase is false");
}

// --- The camera.

TEST(SavedCellValidation, BoundsTheRowsOfTheCamera) {
  SavedCell saved = validated_home();
  saved.workcell.camera = test::workcell_named("rhino-xr3").camera;
  saved.workcell.camera->pixels_x = saved.workcell.camera->pixels_y = 2048;
  const PointUm eye = saved.workcell.camera->location_um;
  const Block block{"b", {900'000, 900'000, 2000}, {eye.x, eye.y, 1000}, 0, 1};
  saved.state.blocks.edit().assign(kMaxCameraRows / 2048, block);
  EXPECT_EQ(invalid_pointers(saved), Strings{});
  saved.state.blocks.edit().push_back(block);
  expect_refused(saved, "/state/blocks", "blocks that take 501760 rows of the camera's image",
                 "at most 500000, counted for each block");
}

}  // namespace
}  // namespace xr3
