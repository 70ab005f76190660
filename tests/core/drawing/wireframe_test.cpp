// The wire frame: order and colours of the parts, each transformed by its own frame; jaws that open
// by the tool's variable; blocks as boxes; and the tip's path.
#include "core/drawing/wireframe.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "core/grasp.hpp"
#include "core/home.hpp"
#include "tests/support/rig.hpp"

namespace xr3 {
namespace {

using test::positions_at;
using test::rhino;
using test::robot_named;
using test::state_at;
using test::workcell_named;

constexpr double kTinyMm = 1e-9;
const char* const kRobots[] = {"rhino-xr3", "adept-one", "intelledex-660", "rhino-xr3-accessories"};

ModelPtr cell_of(const std::string& name) {
  return std::make_shared<const Model>(robot_named(name), workcell_named(name), Profile::kPaper);
}

std::vector<Wire> of_part(const std::vector<Wire>& wires, const std::string& part) {
  std::vector<Wire> found;
  for (const Wire& wire : wires) {
    if (wire.part == part) found.push_back(wire);
  }
  return found;
}

/// A joint of 90 degrees per count about z with a link 10 mm long, then a slide of 1 mm per count.
Robot two_links() {
  Robot robot;
  Joint turning;
  turning.dh = {0, 5, 10, 0};
  turning.drive = {'C', 90, -180, 180, 0, 100, 1, {}};
  Joint lifting;
  lifting.variable = JointVariable::kD;
  lifting.drive = {'B', 1, 0, 100, 0, 100, 1, {}};
  robot.joints = {turning, lifting};
  robot.tool.drive = {'A', 1, 0, 90, 0, 100, 1, {}};
  const std::vector<OutlinePoint> mark{{false, {0, 0, 0}}, {true, {1, 2, 3}}};
  robot.links = {{1, mark}, {2, mark}, {3, mark}};
  return robot;
}

TEST(Wireframe, EachLinkMovesWithItsOwnFrame) {
  const ModelPtr model = test::model_of(two_links());
  const std::vector<Wire> wires = robot_wires(*model, positions_at(*model, {{'C', 1}, {'B', 7}}));
  ASSERT_EQ(wires.size(), 3u);
  EXPECT_EQ(wires[0], (Wire{"base", 1, {{0, 0, 0}, {1, 2, 3}}}));
  EXPECT_EQ(wires[1], (Wire{"link1", 2, {{0, 10, 5}, {-2, 11, 8}}}));
  EXPECT_EQ(wires[2], (Wire{"tool", 3, {{0, 10, 12}, {-2, 11, 15}}}));
}

TEST(Wireframe, AMoveStartsANewPolyline) {
  Robot robot = two_links();
  robot.links[0].points = {{true, {1, 0, 0}},  {true, {2, 0, 0}}, {false, {3, 0, 0}},
                           {false, {4, 0, 0}}, {true, {5, 0, 0}}, {false, {6, 0, 0}}};
  const ModelPtr model = test::model_of(robot);
  const std::vector<Wire> base = of_part(robot_wires(*model, Positions{}), "base");
  ASSERT_EQ(base.size(), 2u) << "a single point is not a line";
  EXPECT_EQ(base[0].points, (std::vector<Eigen::Vector3d>{{1, 0, 0}, {2, 0, 0}}));
  EXPECT_EQ(base[1].points, (std::vector<Eigen::Vector3d>{{4, 0, 0}, {5, 0, 0}}));
}

TEST(Wireframe, ParallelJawsShiftByHalfTheOpening) {
  Robot robot = two_links();
  robot.links.assign(3, {});
  const std::vector<OutlinePoint> mark{{false, {0, 0, 0}}, {true, {0, 0, -4}}};
  robot.tool.parts = {{1, 11, {0, 0, 0}, mark}, {-1, 12, {0, 0, 0}, mark}};
  const ModelPtr model = test::model_of(robot);
  const std::vector<Wire> wires = robot_wires(*model, positions_at(*model, {{'A', 30}}));
  ASSERT_EQ(wires.size(), 2u);
  EXPECT_EQ(wires[0], (Wire{"finger+1", 11, {{10, 15, 5}, {10, 15, 1}}}));
  EXPECT_EQ(wires[1], (Wire{"finger-1", 12, {{10, -15, 5}, {10, -15, 1}}}));
}

TEST(Wireframe, AngularJawsTurnAboutTheirPivots) {
  Robot robot = two_links();
  robot.links.assign(3, {});
  robot.tool.kind = ToolKind::kAngular;
  robot.tool.finger_length_mm = 8;
  const PointMm pivot{0, 0, -8};
  const std::vector<OutlinePoint> finger{{false, pivot}, {true, {0, 0, 0}}};
  robot.tool.parts = {{1, 11, pivot, finger}, {-1, 12, pivot, finger}};
  const ModelPtr model = test::model_of(robot);
  const Positions open = positions_at(*model, {{'A', 60}});
  const std::vector<Wire> wires = robot_wires(*model, open);
  ASSERT_EQ(wires.size(), 2u);
  const Eigen::Vector3d up(10, -4, 5 - 8 + 8 * std::sqrt(0.75));  // about +x, z turns towards -y
  EXPECT_LT((wires[0].points[0] - Eigen::Vector3d(10, 0, -3)).norm(), kTinyMm);
  EXPECT_LT((wires[0].points[1] - up).norm(), kTinyMm);
  EXPECT_LT((wires[1].points[1] - up.cwiseProduct(Eigen::Vector3d(1, -1, 1))).norm(), kTinyMm);
  EXPECT_NEAR((wires[0].points[1] - wires[1].points[1]).norm(), opening_mm(*model, 60), kTinyMm);
}

/// The gap in the drawing: the distance between the fingers' inner sides at the tip's height.
double drawn_gap_mm(const Model& model, Counts tool) {
  Positions at{};
  at[static_cast<std::size_t>(model.tool_index())] = tool;
  const Transform to_tool = tool_transform(model, at).inverse();
  double low = -1e9;
  double high = 1e9;
  for (const Wire& wire : robot_wires(model, at)) {
    if (!wire.part.starts_with("finger")) continue;
    for (const Eigen::Vector3d& p : wire.points) {
      const Eigen::Vector4d q = to_tool * p.homogeneous();
      if (q.z() < -25) continue;
      (q.y() > 0 ? high : low) = q.y() > 0 ? std::min(high, q.y()) : std::max(low, q.y());
    }
  }
  return high - low;
}

TEST(Wireframe, TheDistanceOfTheDrawnFingersIsTheOpening) {
  for (const char* robot : kRobots) {
    const ModelPtr model = cell_of(robot);
    for (const Counts tool : {0, model->motor(model->tool_index()).low}) {
      EXPECT_NEAR(drawn_gap_mm(*model, tool), opening_mm(*model, tool), 1.0)
          << robot << " " << tool;
    }
  }
}

TEST(Wireframe, HasEveryPartOfTheRobots) {
  for (const char* robot : kRobots) {
    const ModelPtr model = cell_of(robot);
    std::vector<std::string> parts;
    for (const Wire& wire : wireframe(*model, initial_state(*model))) {
      ASSERT_GE(wire.points.size(), 2u);
      if (parts.empty() || parts.back() != wire.part) parts.push_back(wire.part);
    }
    std::vector<std::string> wanted{"base"};
    for (int k = 1; k < model->joint_count(); ++k) wanted.push_back("link" + std::to_string(k));
    wanted.insert(wanted.end(), {"tool", "finger+1", "finger-1"});
    if (model->carousel()) wanted.emplace_back("carousel");
    for (const Block& block : model->workcell().blocks) wanted.push_back("block:" + block.name);
    std::erase_if(wanted, [&](const std::string& part) {  // a link may have no outline
      return part.starts_with("link") &&
             model->robot().links[static_cast<std::size_t>(part.back() - '0')].points.empty();
    });
    EXPECT_EQ(parts, wanted) << robot;
  }
}

// A quarter turn: the diameter along x now lies along y.
TEST(Wireframe, TheCarouselTurns) {
  const ModelPtr model = cell_of("rhino-xr3-accessories");
  Positions at{};
  const auto diameter = [&] {
    std::vector<Wire> wires = robot_wires(*model, at);
    const Wire wire = wires[wires.size() - 2];
    EXPECT_EQ(wire.part, "carousel");
    return wire.points;
  };
  EXPECT_TRUE(diameter()[0].isApprox(Eigen::Vector3d(450, 330, 40)));
  at[static_cast<std::size_t>(model->carousel_index())] = 288;
  EXPECT_TRUE(diameter()[0].isApprox(Eigen::Vector3d(330, 450, 40)));
  EXPECT_TRUE(diameter()[1].isApprox(Eigen::Vector3d(330, 210, 40)));
}

using Edge = std::pair<std::array<double, 3>, std::array<double, 3>>;

std::array<double, 3> rounded(const Eigen::Vector3d& p) {
  const auto um = [](double v) { return static_cast<double>(micrometres(v)); };
  return {um(p.x()), um(p.y()), um(p.z())};
}

Edge edge(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a < b ? Edge{a, b} : Edge{b, a};
}

std::multiset<Edge> edges_of(const std::vector<Wire>& wires) {
  std::multiset<Edge> edges;
  for (const Wire& wire : wires) {
    for (std::size_t i = 1; i < wire.points.size(); ++i) {
      edges.insert(edge(rounded(wire.points[i - 1]), rounded(wire.points[i])));
    }
  }
  return edges;
}

/// The edges of a box: pairs of corners that differ in one of three directions.
std::multiset<Edge> box_edges(const Transform& pose, const PointUm& size) {
  const auto corner = [&](int bits) {
    const Eigen::Vector4d p((bits & 1 ? 0.5 : -0.5) * mm(size.x),
                            (bits & 2 ? 0.5 : -0.5) * mm(size.y),
                            (bits & 4 ? 0.5 : -0.5) * mm(size.z), 1);
    return rounded((pose * p).head<3>());
  };
  std::multiset<Edge> edges;
  for (int bits = 0; bits < 8; ++bits) {
    for (const int direction : {1, 2, 4}) {
      if ((bits & direction) == 0) edges.insert(edge(corner(bits), corner(bits | direction)));
    }
  }
  return edges;
}

TEST(Wireframe, ABlockHasItsTwelveEdgesOnce) {
  const ModelPtr model = cell_of("rhino-xr3");
  State state = state_at(*model, {{'F', 90}, {'E', 300}, {'D', -400}, {'C', 200}});
  state.held = Held{0, 0, positions_at(*model, {{'E', 449}, {'D', -625}})};
  for (std::size_t i = 0; i < state.blocks.size(); ++i) {
    const Block& block = state.blocks[i];
    const std::vector<Wire> wires = of_part(block_wires(*model, state), "block:" + block.name);
    EXPECT_EQ(wires.size(), 4u);
    EXPECT_EQ(wires.front().color, block.color);
    EXPECT_EQ(edges_of(wires), box_edges(block_pose(*model, state, i), block.size_um))
        << block.name;
  }
}

TEST(Wireframe, ThePathStartsAtItsOldestPoint) {
  State state = initial_state(*rhino());
  EXPECT_TRUE(path_wires(state).empty());
  state.tip_path.points = {{1000, 0, 0}};
  EXPECT_TRUE(path_wires(state).empty());
  state.tip_path.points = {{3000, 0, 0}, {1000, 0, 0}, {2000, 500, 0}};
  state.tip_path.oldest = 1;
  EXPECT_EQ(path_wires(state),
            (std::vector<Wire>{{"path", kPathColor, {{1, 0, 0}, {2, 0.5, 0}, {3, 0, 0}}}}));
  EXPECT_EQ(wireframe(*rhino(), state).back().part, "path");
}

TEST(Wireframe, TheProjectionKeepsPartsAndPoints) {
  const std::vector<FlatWire> flat = projected(view_along({0, 0, 1}), {{"a", 3, {{1, 2, 3}}}});
  EXPECT_EQ(flat, (std::vector<FlatWire>{{"a", 3, {{1, 2}}}}));
}

TEST(Wireframe, BehindIsTheRearmostPointOfTheOutlineAtHome) {
  EXPECT_NEAR(behind_mm(*cell_of("rhino-xr3")), 152.4, 0.1);
  Robot robot = two_links();
  robot.links[2].points = {{false, {-25, 0, 0}}, {true, {4, 0, 0}}};  // frame 2 is at x = 10
  EXPECT_NEAR(behind_mm(*test::model_of(robot)), 15, kTinyMm);
  robot.links.assign(3, {});
  EXPECT_EQ(behind_mm(*test::model_of(robot)), 0);
}

TEST(Wireframe, TheSurfaceIsTheTableInsideTheWorkspace) {
  const Wire surface = surface_wire(workcell_named("adept-one"));
  ASSERT_EQ(surface.points.size(), 5u);
  EXPECT_EQ(surface.points.front(), surface.points.back());
  EXPECT_EQ(surface.points[2], Eigen::Vector3d(900, 800, 500));
}

}  // namespace
}  // namespace xr3
