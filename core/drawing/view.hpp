// The orthographic view (paper, Section II-A): projects points onto the plane perpendicular to the
// view vector, and computes how much of it is shown (Section III-B, "view volume"). For pictures
// only; the simulation does not use it.
#pragma once

#include <Eigen/Core>

#include "core/state.hpp"
#include "core/workcell.hpp"

namespace xr3 {

/// The picture plane: three orthogonal unit vectors in the base frame, right x up = toward.
struct View {
  Eigen::Vector3d right;
  Eigen::Vector3d up;      ///< as near to +z as the plane allows; +y for a view along z
  Eigen::Vector3d toward;  ///< along the view vector, towards the eye
};

/// The view from far out in the direction of `vector`, which must not be 0.
View view_along(const ViewVector& vector);

/// Projects a point of the base frame: x to the right, y up, in mm, with the base's origin at 0.
Eigen::Vector2d projected(const View& view, const Eigen::Vector3d& p_mm);

/// A rectangle in the picture, in mm; low <= high.
struct Extents {
  Eigen::Vector2d low;
  Eigen::Vector2d high;
  bool operator==(const Extents&) const = default;
};

/// The smallest rectangle with the projections of (X,0,0), (0,Y,0), (0,-Y,0), (0,0,Z) and
/// (-behind,0,0).
Extents view_extents(const View& view, const Workspace& workspace, double behind_mm);

}  // namespace xr3
