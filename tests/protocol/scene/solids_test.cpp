// Solids of strokes: prisms and frusta of paired loops, closed and outward; rods; drawn in.
#include "protocol/scene/solids.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "core/units.hpp"
#include "protocol/scene/links.hpp"
#include "protocol/scene/triangulation.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

Stroke loop_at(const std::vector<Eigen::Vector2d>& corners, double z, double scale = 1) {
  Stroke loop;
  for (std::size_t i = 0; i <= corners.size(); ++i) {
    const Eigen::Vector2d& p = corners[i % corners.size()];
    loop.emplace_back(scale * p.x(), scale * p.y(), z);
  }
  return loop;
}

const std::vector<Eigen::Vector2d> kSquare{{-10, -10}, {10, -10}, {10, 10}, {-10, 10}};
const std::vector<Eigen::Vector2d> kL{{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 20}, {0, 20}};

double volume_mm3(const std::vector<Triangle>& faces) {
  double sum = 0;
  for (const Triangle& t : faces) sum += t[0].dot(t[1].cross(t[2])) / 6;
  return sum;
}

/// Whether each edge of a triangle belongs to another one in the opposite direction.
bool is_closed(const std::vector<Triangle>& faces) {
  std::map<std::array<double, 6>, int> edges;
  for (const Triangle& t : faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d &p = t[i], &q = t[(i + 1) % 3];
      ++edges[{p.x(), p.y(), p.z(), q.x(), q.y(), q.z()}];
      --edges[{q.x(), q.y(), q.z(), p.x(), p.y(), p.z()}];
    }
  }
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; });
}

TEST(Solid, OfTwoShiftedLoopsIsAPrism) {
  const Solid solid = solid_of({loop_at(kSquare, 5), loop_at(kSquare, 0)}, 0, BareStrokes::kLines);
  EXPECT_EQ(solid.faces.size(), 12U);
  EXPECT_NEAR(volume_mm3(solid.faces), 20 * 20 * 5, 1e-9);
  EXPECT_TRUE(is_closed(solid.faces));
  EXPECT_EQ(solid.strokes.size(), 2U);
}

TEST(Solid, MayBeHollowedOutByACornerAndRunEitherWay) {
  const std::vector<Eigen::Vector2d> clockwise(kL.rbegin(), kL.rend());
  for (const auto& corners : {kL, clockwise}) {
    const Solid solid =
        solid_of({loop_at(corners, 0), loop_at(corners, 10)}, 0, BareStrokes::kLines);
    EXPECT_NEAR(volume_mm3(solid.faces), 400 * 10, 1e-9);
    EXPECT_TRUE(is_closed(solid.faces));
  }
}

TEST(Solid, OfTwoLoopsOfDifferentSizeIsAFrustum) {
  const Solid solid =
      solid_of({loop_at(kSquare, 0), loop_at(kSquare, 6, 0.5)}, 0, BareStrokes::kLines);
  EXPECT_NEAR(volume_mm3(solid.faces), 6.0 / 3 * (400 + 200 + 100), 1e-9);
}

constexpr std::size_t kFacesOfABox = 12;

TEST(Solid, OfLoopsThatDoNotMatchIsRods) {
  Stroke open = loop_at(kSquare, 5);
  open.pop_back();
  const Stroke line{{0, 0, 0}, {5, 0, 0}, {9, 0, 0}, {0, 0, 0}};
  const Stroke other{{0, 0, 9}, {5, 0, 9}, {9, 0, 9}, {0, 0, 9}};
  const std::vector<std::pair<std::size_t, std::vector<Stroke>>> cases{
      {4, {loop_at(kSquare, 0)}},                             // one loop
      {8, {loop_at(kSquare, 0), loop_at(kSquare, 0.5)}},      // as good as in one plane
      {8, {loop_at(kSquare, 0), loop_at(kSquare, 5, 0.29)}},  // too small
      {10, {loop_at(kSquare, 0), loop_at(kL, 5)}},            // another shape
      {7, {loop_at(kSquare, 0), open}},                       // not closed
      {0, {Stroke(5, {1, 1, 1}), Stroke(5, {1, 1, 9})}},      // points
      {6, {line, other}},                                     // without an area
  };
  for (const auto& [rods, strokes] : cases)
    EXPECT_EQ(solid_of(strokes, 0, BareStrokes::kLines).faces.size(), rods * kFacesOfABox);
}

TEST(Solid, HasOpenStrokesBesideItsPrismsAsLinesOrRods) {
  const std::vector<Stroke> strokes{
      loop_at(kSquare, 0), loop_at(kSquare, 5), {{0, 0, 5}, {0, 0, 50}}};
  EXPECT_EQ(solid_of(strokes, 0, BareStrokes::kLines).faces.size(), kFacesOfABox);
  EXPECT_EQ(solid_of(strokes, 0, BareStrokes::kRods).faces.size(), 2 * kFacesOfABox);
}

TEST(Solid, OfOpenStrokesIsRods) {
  const Solid solid = solid_of({{{0, 0, 0}, {0, 0, 50}, {0, 0, 50}}}, 0, BareStrokes::kRods);
  EXPECT_NEAR(volume_mm3(solid.faces), 4 * 4 * 50, 1e-9);
  EXPECT_TRUE(is_closed(solid.faces));
}

TEST(Solid, IsDrawnInOnEachSide) {
  const Solid solid = solid_of({loop_at(kSquare, 0), loop_at(kSquare, 5)}, 1, BareStrokes::kLines);
  EXPECT_NEAR(volume_mm3(solid.faces), 18 * 18 * 3, 1e-9);
  EXPECT_EQ(solid.strokes[1], loop_at(kSquare, 5)) << "edges stay where they are";
}

TEST(Solid, OfShippedRobotsIsClosedAndOutward) {
  for (const std::string& name : test::kShippedRobots) {
    for (const SceneLink& link : scene_links(*test::model_of(test::robot_named(name)))) {
      EXPECT_EQ(link.solid.faces.empty(), link.name == "tool") << name << " " << link.name;
      EXPECT_TRUE(is_closed(link.solid.faces)) << name << " " << link.name;
      EXPECT_GE(volume_mm3(link.solid.faces), 0) << name << " " << link.name;
    }
  }
}

/// A polygon around the origin: corners at increasing angles, at any distance.
std::vector<Eigen::Vector2d> some_star() {
  const auto radii = *rc::gen::resize(
      40, rc::gen::suchThat(rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 1000)),
                            [](const auto& all) { return all.size() >= 3; }));
  std::vector<Eigen::Vector2d> polygon;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double angle = 2 * kPi * static_cast<double>(i) / static_cast<double>(radii.size());
    polygon.emplace_back(radii[i] * std::cos(angle), radii[i] * std::sin(angle));
  }
  return polygon;
}

double area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x()) / 2;
}

RC_GTEST_PROP(Triangulation, CoversThePolygonOnce, ()) {
  const std::vector<Eigen::Vector2d> polygon = some_star();
  const auto triangles = triangulated(polygon);
  RC_ASSERT(triangles.size() == polygon.size() - 2);
  double sum = 0, whole = 0;
  for (const auto& [i, j, k] : triangles) {
    RC_ASSERT(area(polygon[i], polygon[j], polygon[k]) >= -1e-6);
    sum += area(polygon[i], polygon[j], polygon[k]);
  }
  for (std::size_t i = 0; i < polygon.size(); ++i)
    whole += area({0, 0}, polygon[i], polygon[(i + 1) % polygon.size()]);
  RC_ASSERT(std::abs(sum - whole) < 1e-6 * whole);
}

TEST(Triangulation, EndsForAPolygonThatCrossesItself) {
  EXPECT_EQ(triangulated({{0, 0}, {10, 10}, {10, 0}, {0, 10}}).size(), 2U);
}

}  // namespace
}  // namespace xr3
