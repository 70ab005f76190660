#include "core/drawing/stick_figure.hpp"

#include <algorithm>
#include <cmath>

#include "core/trig.hpp"

namespace xr3 {
namespace {

constexpr int kLinkColor = 7;
constexpr int kJawColor = 11;
constexpr int kSidesOfTurning = 6;
constexpr int kSidesOfSliding = 4;
constexpr double kMarkersPerArm = 60;  ///< the arm's length in radii of a marker
constexpr double kLeastRadiusMm = 1;
constexpr double kJawRadii = 3;  ///< length of parallel jaws in radii of a marker

using Points = std::vector<OutlinePoint>;

double marker_radius_mm(const Robot& robot) {
  double sum = 0;
  for (const Joint& joint : robot.joints) sum += std::hypot(joint.dh.d_mm, joint.dh.a_mm);
  return std::max(sum / kMarkersPerArm, kLeastRadiusMm);
}

/// The point of the joint's axis at this distance before the line along a, in the link's frame.
PointMm on_axis(const DhRow& row, double d_mm) {
  const auto [sin, cos] = sin_cos_deg(row.alpha_deg);
  return {-row.a_mm, -d_mm * sin, -d_mm * cos};
}

void add_line(Points& points, const PointMm& from, const PointMm& to) {
  if (from == to) return;
  points.push_back({false, from});
  points.push_back({true, to});
}

/// The lines of a row whose d is between these, in the frame after it.
void add_row(Points& points, const DhRow& row, double low_mm, double high_mm) {
  add_line(points, on_axis(row, std::max(high_mm, 0.0)), on_axis(row, std::min(low_mm, 0.0)));
  add_line(points, on_axis(row, 0), {});
}

void add_joint(Points& points, const Joint& joint) {
  const double d = joint.dh.d_mm;
  joint.is_revolute() ? add_row(points, joint.dh, d, d)
                      : add_row(points, joint.dh, joint.drive.min, joint.drive.max);
}

void add_ring(Points& points, int sides, double radius, double z) {
  for (int i = 0; i <= sides; ++i) {
    const auto [sin, cos] = sin_cos_deg(360.0 / sides * i);
    points.push_back({i > 0, {radius * cos, radius * sin, z}});
  }
}

/// A prism about z, the axis of the joint after this frame.
void add_marker(Points& points, const Joint& next, double radius) {
  const int sides = next.is_revolute() ? kSidesOfTurning : kSidesOfSliding;
  add_ring(points, sides, radius, -radius);
  add_ring(points, sides, radius, radius);
}

std::vector<Outline> links_of(const Robot& robot) {
  const double radius = marker_radius_mm(robot);
  std::vector<Outline> links(robot.joints.size() + 1, {kLinkColor, {}});
  if (robot.mount) add_row(links[0].points, *robot.mount, robot.mount->d_mm, robot.mount->d_mm);
  for (std::size_t k = 0; k < robot.joints.size(); ++k) {
    add_marker(links[k].points, robot.joints[k], radius);
    add_joint(links[k + 1].points, robot.joints[k]);
  }
  return links;
}

/// A jaw, closed: across from the other side, so that it meets the arm however wide it is open, and
/// along to the tip.
ToolPart parallel_jaw(const Robot& robot, int side) {
  const double length = kJawRadii * marker_radius_mm(robot);
  const double across = -side * robot.tool.drive.max / 2;
  return {
      side, kJawColor, {}, {{false, {0, across, -length}}, {true, {0, 0, -length}}, {true, {}}}};
}

ToolPart angular_jaw(const Robot& robot, int side) {
  const PointMm pivot{0, 0, -robot.tool.finger_length_mm};
  return {side, kJawColor, pivot, {{false, pivot}, {true, {}}}};
}

std::vector<ToolPart> jaws_of(const Robot& robot) {
  const bool slides = robot.tool.kind == ToolKind::kParallel;
  const auto jaw = slides ? parallel_jaw : angular_jaw;
  return {jaw(robot, 1), jaw(robot, -1)};
}

}  // namespace

std::optional<Robot> stick_figure(const Robot& robot) {
  if (!robot.links.empty()) return std::nullopt;
  Robot figure = robot;
  figure.links = links_of(robot);
  if (figure.tool.parts.empty()) figure.tool.parts = jaws_of(robot);
  return figure;
}

}  // namespace xr3
