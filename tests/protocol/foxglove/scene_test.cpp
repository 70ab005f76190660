// The pictures of links and blocks, and the frames with which blocks move.
#include "protocol/foxglove/scene.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/grasp.hpp"
#include "core/workcell_edit.hpp"
#include "protocol/json/document.hpp"
#include "tests/support/rig.hpp"

namespace xr3::foxglove {
namespace {

using test::Rig;

constexpr Counts kQuarterTurn = 288;  // of the carousel

ModelPtr accessories() {
  Workcell workcell = test::bare_workcell();
  workcell.workspace.y_um = 800'000;
  workcell.blocks = {
      {"on", {60'000, 30'000, 30'000}, {400'000, 340'000, 55'000}, microdegrees(30), 12},
      {"off", {60'000, 30'000, 30'000}, {300'000, -100'000, 15'000}, microdegrees(-10), 1}};
  return std::make_shared<const Model>(test::robot_named("rhino-xr3-accessories"), workcell,
                                       Profile::kPaper);
}

/// The pose of a frame in the base.
Transform pose_of(const std::string& frame, const Model& model, const State& state) {
  const std::vector<SceneLink> links = scene_links(model);
  const Positions at = positions(model, state.motors);
  Transform pose = Transform::Identity();
  int link = 0;
  while (links[static_cast<std::size_t>(link)].name != frame) ++link;
  for (; link > 0; link = links[static_cast<std::size_t>(link)].parent) {
    const SceneLink& each = links[static_cast<std::size_t>(link)];
    const double variable =
        each.motor < 0 ? 0 : model.variable(each.motor, at[static_cast<std::size_t>(each.motor)]);
    pose = relative_pose(each, variable) * pose;
  }
  return pose;
}

void expect_right_places(const Model& model, const State& state) {
  const std::vector<PlacedBlock> placed = placed_blocks(model, state);
  ASSERT_EQ(placed.size(), state.blocks.size());
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const Transform shown = pose_of(placed[i].frame, model, state) * placed[i].pose;
    EXPECT_LT((shown - block_pose(model, state, i)).norm(), 2e-3) << placed[i].block.name;
  }
}

TEST(FoxgloveScene, ABlockOnTheCarouselStaysInItsFrame) {
  Rig rig(accessories());
  const std::vector<PlacedBlock> before = placed_blocks(rig.model(), rig.state());
  EXPECT_EQ(before[0].frame, "carousel");
  EXPECT_EQ(before[1].frame, "base");
  for (int i = 0; i < 4; ++i) {
    expect_right_places(rig.model(), rig.state());
    rig.travel('H', kQuarterTurn / 3);
    EXPECT_EQ(placed_blocks(rig.model(), rig.state()), before);
  }
}

TEST(FoxgloveScene, AHeldBlockStaysInTheFrameOfTheTool) {
  const ModelPtr model = accessories();
  State state = test::state_at(*model, {{'F', 100}, {'D', -50}});
  state.held = Held{1, 0, positions(*model, state.motors)};
  const std::vector<PlacedBlock> grasped = placed_blocks(*model, state);
  EXPECT_EQ(grasped[1].frame, "tool");
  state.motor(model->index_of('F')).count += 200;
  state.motor(model->index_of('B')).count += 77;
  EXPECT_EQ(placed_blocks(*model, state), grasped);
  expect_right_places(*model, state);
}

TEST(FoxgloveScene, AMessageReplacesAllBlocks) {
  const ModelPtr model = accessories();
  const auto message = Json::parse(blocks_text(placed_blocks(*model, initial_state(*model)), 7));
  EXPECT_EQ(message["deletions"].dump(), R"([{"timestamp":{"sec":0,"nsec":7},"type":1,"id":""}])");
  ASSERT_EQ(message["entities"].size(), 2U);
  EXPECT_EQ(message["entities"][1]["id"], "off");
  EXPECT_EQ(message["entities"][1]["cubes"][0]["size"].dump(), R"({"x":0.06,"y":0.03,"z":0.03})");
}

TEST(FoxgloveScene, EachRobotHasFacesAndLines) {
  for (const std::string& name : test::kShippedRobots) {
    const ModelPtr model = test::model_of(test::robot_named(name));
    const auto message = Json::parse(scene_text(scene_links(*model), 0));
    std::size_t corners = 0;
    for (const Json& entity : message["entities"]) {
      EXPECT_EQ(entity["frame_id"], entity["id"]);
      EXPECT_EQ(entity["lines"].size(), 1U);
      for (const Json& faces : entity["triangles"]) corners += faces["points"].size();
    }
    EXPECT_GT(corners, 100U) << name;
    EXPECT_EQ(corners % 3, 0U);
  }
}

TEST(FoxgloveScene, AStickFigureHasAPicture) {
  const ModelPtr model = test::model_of(test::odd_arm(4));
  EXPECT_FALSE(Json::parse(scene_text(scene_links(*model), 0))["entities"].empty());
}

}  // namespace
}  // namespace xr3::foxglove
