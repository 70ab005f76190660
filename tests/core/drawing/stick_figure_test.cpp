// The stick figure: lines from joint to joint, markers, and jaws that open by the tool's variable.
#include "core/drawing/stick_figure.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <vector>

#include "core/drawing/wireframe.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::positions_at;

constexpr double kNearMm = 1e-9;

/// A joint of 90 degrees per count about z with d 5 and a 10 mm, whose next axis is along -y; then
/// a slide of 1 mm per count.
Robot turning_and_sliding() {
  Robot robot;
  Joint turning;
  turning.dh = {0, 5, 10, 90};
  turning.drive = {'C', 90, -180, 180, 0, 100, 1, {}};
  Joint sliding;
  sliding.variable = JointVariable::kD;
  sliding.drive = {'B', 1, 0, 100, 0, 100, 1, {}};
  robot.joints = {turning, sliding};
  robot.tool.drive = {'A', 1, 0, 60, 0, 100, 1, {}};
  return robot;
}

Robot without_outlines(Robot robot) {
  robot.links.clear();
  robot.tool.parts.clear();
  return robot;
}

/// The wires of a part with two points: lines, not rings.
std::vector<Wire> lines_of(const Model& model, const std::string& part, const Positions& at) {
  std::vector<Wire> lines = robot_wires(model, at);
  std::erase_if(lines,
                [&](const Wire& wire) { return wire.part != part || wire.points.size() != 2; });
  return lines;
}

bool is_line(const Wire& wire, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return (wire.points[0] - from).norm() < kNearMm && (wire.points[1] - to).norm() < kNearMm;
}

double distance_to_line(const Wire& wire, const Eigen::Vector3d& p) {
  const Eigen::Vector3d along = wire.points[1] - wire.points[0];
  const double t = std::clamp((p - wire.points[0]).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (wire.points[0] + t * along - p).norm();
}

TEST(StickFigure, ARobotWithOutlinesHasNone) {
  for (const std::string& name : test::kShippedRobots)
    EXPECT_FALSE(stick_figure(test::robot_named(name)).has_value()) << name;
}

TEST(StickFigure, OnlyTheDrawingDiffersFromTheRobot) {
  Robot robot = without_outlines(test::robot_named("rhino-xr3-accessories"));
  ASSERT_TRUE(stick_figure(robot).has_value());
  EXPECT_EQ(without_outlines(*stick_figure(robot)), robot);
  robot.tool.parts = test::robot_named("rhino-xr3").tool.parts;
  EXPECT_EQ(stick_figure(robot)->tool.parts, robot.tool.parts) << "it keeps parts of its own";
}

TEST(StickFigure, ALinkLeadsAlongDThenAlongA) {
  const ModelPtr model = test::model_of(turning_and_sliding());
  for (const auto& [count, end] : {std::pair{0, Eigen::Vector3d(10, 0, 5)}, {1, {0, 10, 5}}}) {
    const std::vector<Wire> lines = lines_of(*model, "link1", positions_at(*model, {{'C', count}}));
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_TRUE(is_line(lines[0], {0, 0, 0}, {0, 0, 5}));
    EXPECT_TRUE(is_line(lines[1], {0, 0, 5}, end)) << count;
  }
}

TEST(StickFigure, AMountIsALinkToo) {
  Robot robot = turning_and_sliding();
  robot.mount = DhRow{0, 7, -3, 0};
  const ModelPtr model = test::model_of(robot);
  const std::vector<Wire> lines = lines_of(*model, "base", Positions{});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(is_line(lines[0], {0, 0, 0}, {0, 0, 7}));
  EXPECT_TRUE(is_line(lines[1], {0, 0, 7}, {-3, 0, 7}));
}

TEST(StickFigure, TheLineOfASlideIsItsRangeAndPassesThroughItsJoint) {
  Robot robot = turning_and_sliding();
  for (const auto& [low, high] : {std::pair{0, 100}, {20, 80}, {-60, 60}, {-90, -10}}) {
    robot.joints[1].drive.min = low;
    robot.joints[1].drive.max = high;
    robot.joints[1].drive.home = robot.joints[1].dh.d_mm = low;
    const ModelPtr model = test::model_of(robot);
    for (const int count : {0, (high - low) / 2, high - low}) {
      const Positions at = positions_at(*model, {{'B', count}});
      const std::vector<Wire> lines = lines_of(*model, "tool", at);
      ASSERT_EQ(lines.size(), 1U) << "a is 0";
      const double length = (lines[0].points[1] - lines[0].points[0]).norm();
      EXPECT_NEAR(length, std::max(high, 0) - std::min(low, 0), kNearMm);
      const std::vector<Transform> frames = base_transforms(*model, at);
      for (const Transform& frame : {frames[1], frames[2]})
        EXPECT_LT(distance_to_line(lines[0], frame.block<3, 1>(0, 3)), kNearMm)
            << low << " " << count;
    }
  }
}

TEST(StickFigure, EachJointHasAMarkerAboutItsAxis) {
  const ModelPtr model = test::model_of(turning_and_sliding());
  std::vector<Wire> rings = robot_wires(*model, Positions{});
  std::erase_if(rings, [](const Wire& wire) { return wire.points.size() <= 3; });
  ASSERT_EQ(rings.size(), 4U);
  EXPECT_EQ(rings[0].part, "base");
  EXPECT_EQ(rings[0].points.size(), 7U) << "six sides: it turns";
  EXPECT_EQ(rings[0].points.front(), rings[0].points.back());
  EXPECT_LT(rings[0].points[0].z(), 0);
  EXPECT_GT(rings[1].points[0].z(), 0);
  EXPECT_EQ(rings[2].part, "link1");
  EXPECT_EQ(rings[2].points.size(), 5U) << "four sides: it slides";
  for (const Eigen::Vector3d& p : rings[3].points)
    EXPECT_NEAR(p.y(), rings[3].points[0].y(), kNearMm) << "its axis is along y";
}

TEST(StickFigure, ItIsInOnePieceWithEveryShippedRobot) {
  for (const std::string& name : test::kShippedRobots) {
    const ModelPtr model = test::model_of(without_outlines(test::robot_named(name)));
    std::vector<Wire> wires = robot_wires(*model, Positions{});
    std::erase_if(wires, [](const Wire& wire) { return wire.points.size() != 2; });
    for (const Transform& frame : base_transforms(*model, Positions{})) {
      const Eigen::Vector3d origin = frame.block<3, 1>(0, 3);
      EXPECT_TRUE(
          std::any_of(wires.begin(), wires.end(),
                      [&](const Wire& wire) { return distance_to_line(wire, origin) < 1e-6; }))
          << name << " has no line at " << origin.transpose();
    }
  }
}

/// The two jaws, the one on the side +1 first.
std::vector<Wire> jaws(const Model& model, Counts count) {
  std::vector<Wire> wires = robot_wires(model, positions_at(model, {{'A', count}}));
  std::erase_if(wires, [](const Wire& wire) { return !wire.part.starts_with("finger"); });
  return wires;
}

TEST(StickFigure, TheEndsOfTheJawsAreAsFarApartAsTheyAreOpen) {
  Robot parallel = turning_and_sliding();
  Robot angular = parallel;
  angular.tool.kind = ToolKind::kAngular;
  angular.tool.finger_length_mm = 8;
  for (const Robot& robot : {parallel, angular}) {
    const ModelPtr model = test::model_of(robot);
    for (const Counts count : {0, 17, 60}) {
      const std::vector<Wire> wires = jaws(*model, count);
      ASSERT_EQ(wires.size(), 2U);
      const double gap = (wires[0].points.back() - wires[1].points.back()).norm();
      EXPECT_NEAR(gap, opening_mm(*model, count), kNearMm);
    }
  }
}

TEST(StickFigure, ParallelJawsMeetTheArmHoweverWideTheyAreOpen) {
  const ModelPtr model = test::model_of(turning_and_sliding());
  for (const Counts count : {0, 17, 60}) {
    const Transform to_tool =
        tool_transform(*model, positions_at(*model, {{'A', count}})).inverse();
    for (const Wire& jaw : jaws(*model, count)) {
      ASSERT_EQ(jaw.points.size(), 3U);
      const double from = (to_tool * jaw.points[0].homogeneous()).y();
      const double to = (to_tool * jaw.points[1].homogeneous()).y();
      EXPECT_LE(std::min(from, to), kNearMm) << count;
      EXPECT_GE(std::max(from, to), -kNearMm) << count;
    }
  }
}

}  // namespace
}  // namespace xr3
