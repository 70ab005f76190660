// The wire frame (paper, Sections II-A and III-A) as polylines: the outlines of links and tool,
// transformed to the base frame, the blocks and the tip's path. For pictures only; the simulation
// does not use it.
//
// The flow through the folder: wireframe() takes a model and a state and returns polylines in the
// base frame, in mm: the outlines of robot and tool at the current positions (stick_figure.hpp
// makes those of a robot whose file has none), the blocks at their current poses (core/grasp.hpp),
// and the path of the tip. view.hpp makes a picture plane from a view vector and projects points
// onto it; projected() does so for wires. view_extents() says which rectangle of that plane the
// paper shows, which needs behind_mm(). palette.hpp has the sixteen colours to which the wires'
// indices refer, for a dark and for a light background. status_line.hpp writes the line of text
// below the picture. The callers are the monitor's channel `display` (protocol/monitor/display.hpp)
// and the pictures of tools/drawing; neither changes the state.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/drawing/view.hpp"
#include "core/kinematics.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Lines from point to point; at least two points. `part` is "base", "link1", "link2", ..., "tool"
/// (link n), "finger+1" or "finger-1" (a moving part of the tool, with its side), "carousel",
/// "block:NAME", "path" or "surface". A part may consist of several polylines.
template <class Point>
struct Polyline {
  std::string part;
  int color = 0;  ///< palette index 0...15
  std::vector<Point> points;
  bool operator==(const Polyline&) const = default;
};

using Wire = Polyline<Eigen::Vector3d>;      ///< in the base frame, mm
using FlatWire = Polyline<Eigen::Vector2d>;  ///< projected onto a view, mm

/// Palette indices of the tip's path and of the work surface.
inline constexpr int kPathColor = 4;
inline constexpr int kSurfaceColor = 8;

/// A circle of the carousel is a polygon with these corners.
inline constexpr int kRingCorners = 24;
/// Height of the carousel's disc, below which is its column.
inline constexpr double kTableThicknessMm = 12;

/// Links from the base to the tool's body, then the tool's moving parts, then the carousel.
std::vector<Wire> robot_wires(const Model& model, const Positions& positions);

/// The twelve edges of each block at its current pose, as four polylines per block.
std::vector<Wire> block_wires(const Model& model, const State& state);

/// The tip's path from its oldest point on; empty if it has fewer than two points.
std::vector<Wire> path_wires(const State& state);

/// Robot, blocks and path, in that order.
std::vector<Wire> wireframe(const Model& model, const State& state);

/// The part of the work surface within the workspace, as a rectangle.
Wire surface_wire(const Workcell& workcell);

/// The wires in the plane of the view, in mm.
std::vector<FlatWire> projected(const View& view, const std::vector<Wire>& wires);

/// The length of the robot's outline behind the base axis (towards -x) at the soft home, in mm; at
/// least 0.
double behind_mm(const Model& model);

}  // namespace xr3
