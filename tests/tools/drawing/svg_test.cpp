// Layout of a wire frame in pixels: one scale, a margin, y downwards; and its SVG text.
#include "tools/drawing/svg.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

constexpr double kTinyPx = 1e-9;

FlatWire wire(std::vector<Eigen::Vector2d> points, const std::string& part = "base") {
  return {part, 1, std::move(points)};
}

void expect_point(const Eigen::Vector2d& p, double x, double y) {
  EXPECT_NEAR(p.x(), x, kTinyPx);
  EXPECT_NEAR(p.y(), y, kTinyPx);
}

TEST(Picture, HasOneScaleAndYPointsDown) {
  const Picture picture =
      lay_out({wire({{-100, 0}, {300, 200}, {0, 50}})}, {{-100, 0}, {300, 200}}, 440);
  EXPECT_EQ(picture.width_px, 440);
  EXPECT_EQ(picture.height_px, 240);
  expect_point(picture.wires[0].points[0], 20, 220);
  expect_point(picture.wires[0].points[1], 420, 20);
  expect_point(picture.wires[0].points[2], 120, 170);
}

TEST(Picture, ATallDrawingIsScaledDownAndCentred) {
  const Picture picture = lay_out({wire({{0, 0}, {10, 1000}})}, {{0, 0}, {10, 1000}}, 120);
  EXPECT_EQ(picture.height_px, 240);
  expect_point(picture.wires[0].points[0], 59, 220);
  expect_point(picture.wires[0].points[1], 61, 20);
}

TEST(Picture, AnEmptyDrawingIsSmall) {
  const Picture picture = lay_out({}, {{0, 0}, {0, 0}}, 100);
  EXPECT_EQ(picture.width_px, 100);
  EXPECT_EQ(picture.height_px, 100);
}

TEST(Picture, ContainsEveryPoint) {
  const Extents grown = around({{0, 0}, {10, 10}}, {wire({{-5, 3}, {4, 20}}), wire({{1, -2}})});
  EXPECT_EQ(grown, (Extents{{-5, -2}, {10, 20}}));
  EXPECT_EQ(around(grown, {}), grown);
}

TEST(Svg, HasOnePathPerPart) {
  Picture picture{200, 100, Background::kLight, "a <b> & \"c\"", {}};
  picture.wires = {wire({{1, 2}, {3.456, -0.001}}),
                   wire({{5, 6.1}, {7, 8}, {-9.05, 10}}),
                   {"block:r&d\n", 12, {{0, 0}, {100, 50}}}};
  EXPECT_EQ(to_svg(picture),
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200\" height=\"100\" "
            "viewBox=\"0 0 200 100\">\n"
            "<title>a &lt;b&gt; &amp; &quot;c&quot;</title>\n"
            "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
            "<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n"
            "<path data-part=\"base\" stroke=\"#1c3f94\" stroke-width=\"1.4\" "
            "d=\"M1 2L3.46 0M5 6.1L7 8L-9.05 10\"/>\n"
            "<path data-part=\"block:r&amp;d \" stroke=\"#d03030\" stroke-width=\"1.4\" "
            "d=\"M0 0L100 50\"/>\n"
            "</g>\n</svg>\n");
}

TEST(Svg, UsesTheColoursOfItsBackground) {
  const Picture dark{100, 100, Background::kDark, "", {wire({{0, 0}, {1, 1}})}};
  EXPECT_NE(to_svg(dark).find("stroke=\"#4a6fd0\""), std::string::npos);
  EXPECT_EQ(to_svg(dark).find("#ffffff"), std::string::npos);
}

}  // namespace
}  // namespace xr3
