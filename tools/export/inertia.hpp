// Mass and inertia of a link, guessed: robot files have neither, and simulators need both.
#pragma once

#include <Eigen/Core>

#include "protocol/scene/solids.hpp"

namespace xr3 {

/// A homogeneous box, in the frame of the link.
struct BoxInertia {
  Eigen::Vector3d center_mm;
  double mass_kg = 0;
  Eigen::Vector3d moments;  ///< about the axes of the box through its centre, kg m2
};

/// The box around a solid, as dense as a hollow arm; a small box at the origin for no solid.
BoxInertia box_inertia(const Solid& solid);

}  // namespace xr3
