// The wire frame (paper, Sections II-A and III-A): outlines of links and tool carried to the base frame
// by the D-H chain, blocks and the tip's path, as polylines. For pictures only: it decides nothing.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/kinematics.hpp"
#include "core/model.hpp"
#include "core/state.hpp"
#include "core/view.hpp"

namespace xr3 {

/// Lines from point to point, at least two points. Parts are "base", "link1", "link2", ..., "tool"
/// (link n), "finger+1" and "finger-1" by the side of a moving part of the tool, "block:NAME",
/// "path" and "surface"; one part may need several polylines.
template <class Point>
struct Polyline {
  std::string part;
  int color = 0;  ///< palette index 0...15
  std::vector<Point> points;
  bool operator==(const Polyline&) const = default;
};

using Wire = Polyline<Eigen::Vector3d>;      ///< in the base frame, mm
using FlatWire = Polyline<Eigen::Vector2d>;  ///< in a view, mm: see projected()

/// The colour of the tip's path and of the work surface.
inline constexpr int kPathColor = 4;
inline constexpr int kSurfaceColor = 8;

/// Links from the base to the tool's body, then the tool's moving parts.
std::vector<Wire> robot_wires(const Model& model, const Positions& positions);

/// The twelve edges of each block where it is now, tilted if it is held so: four polylines a block.
std::vector<Wire> block_wires(const Model& model, const State& state);

/// The tip's path from its oldest point on; none where it has fewer than two points.
std::vector<Wire> path_wires(const State& state);

/// Robot, blocks and path, in this order.
std::vector<Wire> wireframe(const Model& model, const State& state);

/// The part of the work surface that lies in the workspace, as a rectangle.
Wire surface_wire(const Workcell& workcell);

std::vector<FlatWire> projected(const View& view, const std::vector<Wire>& wires);

/// How far behind the base's axis the robot's outline reaches at the soft home: its furthest -x, mm,
/// 0 or above.
double behind_mm(const Model& model);

}  // namespace xr3
