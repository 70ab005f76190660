// The view plane compared with its definition and with figures computed by hand, and the rectangle
// shown.
#include "core/drawing/view.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/drawing/palette.hpp"

namespace xr3 {
namespace {

constexpr double kTiny = 1e-12;
const double kRoot2 = std::sqrt(2.0);
const double kRoot6 = std::sqrt(6.0);

double distance(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return (a - b).norm(); }

TEST(View, EveryVectorHasAPerpendicularPlane) {
  for (int code = 0; code < 19 * 19 * 19; ++code) {
    const ViewVector vector{code % 19 - 9, code / 19 % 19 - 9, code / 361 - 9};
    if (vector == ViewVector{0, 0, 0}) continue;
    const View view = view_along(vector);
    Eigen::Matrix3d plane;
    plane << view.right, view.up, view.toward;
    ASSERT_LT((plane.transpose() * plane - Eigen::Matrix3d::Identity()).norm(), kTiny);
    ASSERT_NEAR(plane.determinant(), 1, kTiny);
    ASSERT_GT(view.toward.dot(Eigen::Vector3d(vector.x, vector.y, vector.z)), 0.9);
    const bool is_vertical = vector.x == 0 && vector.y == 0;
    ASSERT_GT(is_vertical ? view.up.y() : view.up.z(), 0.1) << "up is up";
    ASSERT_NEAR(is_vertical ? view.right.y() : view.right.z(), 0, kTiny) << "level is level";
  }
}

struct GoldenView {
  ViewVector vector;
  Eigen::Vector3d p;
  Eigen::Vector2d seen;
};

TEST(View, MatchesFiguresComputedByHand) {
  const GoldenView goldens[] = {
      {{1, 1, 1}, {0, 0, 3}, {0, 6 / kRoot6}},
      {{1, 1, 1}, {2, 0, 0}, {-2 / kRoot2, -2 / kRoot6}},  // x to the left
      {{1, 1, 1}, {0, 2, 0}, {2 / kRoot2, -2 / kRoot6}},   // y to the right
      {{1, 1, 1}, {5, 5, 5}, {0, 0}},
      {{1, 0, 0}, {7, 2, 3}, {2, 3}},    // from the front: y to the right
      {{-4, 0, 0}, {7, 2, 3}, {-2, 3}},  // from behind: y to the left
      {{0, 1, 0}, {1, 9, 3}, {-1, 3}},
      {{0, 0, 9}, {1, 2, 3}, {1, 2}},    // from above, as on a map
      {{0, 0, -1}, {1, 2, 3}, {-1, 2}},  // from below
  };
  for (const GoldenView& golden : goldens) {
    const Eigen::Vector2d seen = projected(view_along(golden.vector), golden.p);
    EXPECT_LT(distance(seen, golden.seen), kTiny) << golden.p.transpose();
  }
}

TEST(View, ExtentsEncloseTheFivePoints) {
  const Workspace workspace{600'000, 500'000, 700'000};
  const Extents slanted = view_extents(view_along({1, 1, 1}), workspace, 150);
  EXPECT_LT(distance(slanted.low, {-600 / kRoot2, -600 / kRoot6}), kTiny);
  EXPECT_LT(distance(slanted.high, {500 / kRoot2, 1400 / kRoot6}), 1e-9);
  const Extents above = view_extents(view_along({0, 0, 1}), workspace, 150);
  EXPECT_LT(distance(above.low, {-150, -500}), kTiny);
  EXPECT_LT(distance(above.high, {600, 500}), kTiny);
  const Extents side = view_extents(view_along({0, -1, 0}), workspace, 0);
  EXPECT_LT(distance(side.low, {0, 0}), kTiny);
  EXPECT_LT(distance(side.high, {600, 700}), kTiny);
}

// --- The palette.

double lightness(int color, Background background) {
  const auto [red, green, blue] = color_rgb(color, background);
  return (0.299 * red + 0.587 * green + 0.114 * blue) / 255;
}

TEST(Palette, EveryColourIsReadableOnItsBackground) {
  for (int color = 0; color < kColors; ++color) {
    EXPECT_LT(lightness(color, Background::kLight), 0.65) << color;
    EXPECT_GT(lightness(color, Background::kDark), 0.35) << color;
    for (int other = 0; other < color; ++other) {
      EXPECT_NE(color_hex(color, Background::kLight), color_hex(other, Background::kLight));
      EXPECT_NE(color_hex(color, Background::kDark), color_hex(other, Background::kDark));
    }
  }
}

TEST(Palette, HexAndChannelsAgree) {
  EXPECT_EQ(color_hex(12, Background::kDark), "#ff6b6b");
  EXPECT_EQ(color_rgb(12, Background::kDark), (std::array<std::uint8_t, 3>{0xff, 0x6b, 0x6b}));
}

}  // namespace
}  // namespace xr3
