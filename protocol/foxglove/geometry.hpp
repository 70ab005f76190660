// Times, lengths, poses and colours as the members of Foxglove's schemas: seconds, metres,
// quaternions, and channels from 0 to 1.
#pragma once

#include <Eigen/Core>

#include "core/kinematics.hpp"
#include "protocol/foxglove/time.hpp"
#include "protocol/json/document.hpp"

namespace xr3::foxglove {

/// `{"sec":1,"nsec":500000000}`.
Json time_json(Nanoseconds time);

/// A point, or the size of a box, in metres.
Json metres_json(const Eigen::Vector3d& mm);

/// The rotation of a transform as a unit quaternion.
Json quaternion_json(const Transform& transform);

/// Position and orientation.
Json pose_json(const Transform& transform);

/// The colour with a palette index of 0...15, opaque.
Json color_json(int index);

}  // namespace xr3::foxglove
