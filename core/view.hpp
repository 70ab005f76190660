// The orthographic view (paper, Section II-A): points of space to the plane across the view vector, and
// how much of that plane is shown (Section III-B, "view volume"). For pictures only: it decides nothing.
#pragma once

#include <Eigen/Core>

#include "core/state.hpp"
#include "core/workcell.hpp"

namespace xr3 {

/// The picture plane: three unit vectors of the base frame at right angles, right x up = toward.
struct View {
  Eigen::Vector3d right;
  Eigen::Vector3d up;      ///< as near to +z as the plane allows; +y where one looks along z
  Eigen::Vector3d toward;  ///< along the view vector, to the eye
};

/// The eye is far out on the vector's side. Not all of the vector's numbers are 0.
View view_along(const ViewVector& vector);

/// A point of the base frame in the picture: x to the right, y up, in mm, the base's origin at 0.
Eigen::Vector2d projected(const View& view, const Eigen::Vector3d& p_mm);

/// A rectangle in the picture, in mm; low <= high.
struct Extents {
  Eigen::Vector2d low;
  Eigen::Vector2d high;
  bool operator==(const Extents&) const = default;
};

/// The least rectangle that holds (X,0,0), (0,Y,0), (0,-Y,0), (0,0,Z) and (-behind,0,0).
Extents view_extents(const View& view, const Workspace& workspace, double behind_mm);

}  // namespace xr3
