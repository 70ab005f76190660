// The tree of links: its frames are those of the kinematics and of the wire frame.
#include "protocol/scene/links.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "core/coupling.hpp"
#include "core/drawing/wireframe.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

constexpr double kNearMm = 1e-9;

std::vector<Transform> frames_of(const Model& model, const std::vector<SceneLink>& links,
                                 const Positions& at) {
  std::vector<Transform> frames;
  for (const SceneLink& link : links) {
    const Transform parent = link.parent < 0 ? Transform(Transform::Identity())
                                             : frames[static_cast<std::size_t>(link.parent)];
    const double variable =
        link.is_fixed() ? 0 : model.variable(link.motor, at[static_cast<std::size_t>(link.motor)]);
    frames.push_back(parent * relative_pose(link, variable));
  }
  return frames;
}

/// All strokes in the base frame, with the strokes of each link in the order of its outline.
std::vector<Stroke> placed(const std::vector<SceneLink>& links,
                           const std::vector<Transform>& frames) {
  std::vector<Stroke> strokes;
  for (std::size_t i = 0; i < links.size(); ++i) {
    for (Stroke stroke : links[i].solid.strokes) {
      for (Eigen::Vector3d& p : stroke)
        p = frames[i].block<3, 3>(0, 0) * p + frames[i].block<3, 1>(0, 3);
      strokes.push_back(std::move(stroke));
    }
  }
  return strokes;
}

Positions positions_within_limits(const Model& model) {
  Positions at{};
  for (int i = 0; i < model.motor_count(); ++i) {
    const MotorModel& motor = model.motor(i);
    at[static_cast<std::size_t>(i)] = *rc::gen::inRange(motor.low, motor.high + 1);
  }
  return at;
}

void expect_wire_frame(const Model& model, const Positions& at) {
  const std::vector<SceneLink> links = scene_links(model);
  const std::vector<Stroke> strokes = placed(links, frames_of(model, links, at));
  const std::vector<Wire> wires = robot_wires(model, at);
  RC_ASSERT(strokes.size() == wires.size());
  for (std::size_t i = 0; i < wires.size(); ++i) {
    RC_ASSERT(strokes[i].size() == wires[i].points.size());
    for (std::size_t k = 0; k < strokes[i].size(); ++k)
      RC_ASSERT((strokes[i][k] - wires[i].points[k]).norm() < kNearMm);
  }
}

RC_GTEST_PROP(SceneLinks, DrawTheWireFrameOfEveryRobotAtEveryPose, ()) {
  const std::string name = *rc::gen::elementOf(test::kShippedRobots);
  const ModelPtr model = test::model_of(test::robot_named(name));
  expect_wire_frame(*model, positions_within_limits(*model));
}

RC_GTEST_PROP(SceneLinks, DrawTheWireFrameOfARobotWithoutOutlines, ()) {
  const ModelPtr model = test::model_of(test::odd_arm(*rc::gen::inRange(1, kMaxJoints + 1)));
  expect_wire_frame(*model, positions_within_limits(*model));
}

TEST(SceneLinks, EndWithTheToolAtItsTip) {
  for (const std::string& name : test::kShippedRobots) {
    const ModelPtr model = test::model_of(test::robot_named(name));
    const std::vector<SceneLink> links = scene_links(*model);
    const auto tool = std::find_if(links.begin(), links.end(),
                                   [](const SceneLink& link) { return link.name == "tool"; });
    ASSERT_NE(tool, links.end());
    const Transform drawn =
        frames_of(*model, links, Positions{})[static_cast<std::size_t>(tool - links.begin())];
    EXPECT_LT((drawn - tool_transform(*model, Positions{})).norm(), kNearMm) << name;
  }
}

TEST(SceneLinks, AreNamedByTheLabelsOfTheirJoints) {
  const ModelPtr model = test::model_of(test::robot_named("rhino-xr3-accessories"));
  std::vector<std::string> names;
  for (const SceneLink& link : scene_links(*model)) names.push_back(link.name);
  EXPECT_THAT(names, testing::ElementsAre("base", "link_G", "link_F", "link_E", "link_D", "link_C",
                                          "link_B", "tool", "finger_1", "finger_2", "carousel"));
}

TEST(SceneLinks, OfAStickFigureHaveRodsForItsLines) {
  const ModelPtr model = test::model_of(test::odd_arm(3));
  for (const SceneLink& link : scene_links(*model)) {
    if (link.name != "tool") EXPECT_FALSE(link.solid.faces.empty()) << link.name;
  }
}

}  // namespace
}  // namespace xr3
