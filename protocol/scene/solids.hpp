// Surfaces from the strokes of an outline, as clients/web/src/scene/solids.js makes them. Two
// closed strokes of one shape, one shifted and possibly scaled, are the ends of a prism or frustum,
// which gets faces. Strokes without any prism become rods, which the page draws as lines.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/drawing/strokes.hpp"

namespace xr3 {

/// Corners in mm, counterclockwise seen from outside.
using Triangle = std::array<Eigen::Vector3d, 3>;

struct Solid {
  std::vector<Triangle> faces;
  std::vector<Stroke> strokes;  ///< edges of the faces, and lines without faces
};

/// The treatment of open strokes beside prisms.
enum class BareStrokes : std::uint8_t {
  kLines,  ///< edges of the prisms, or lines on them
  kRods,   ///< parts of the robot, with square rods around their lines
};

/// The solid of these strokes. `inset_mm`: the distance by which each prism is drawn in from its
/// bounding box, so that faces do not share a plane with the edges, nor with those of a solid with
/// another inset.
Solid solid_of(std::vector<Stroke> strokes, double inset_mm, BareStrokes bare);

}  // namespace xr3
