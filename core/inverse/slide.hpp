// An arm that stands on a mount or on a slide: the arm without them, in its own base frame. Its
// inverse kinematics has the closed form of the bare arm once the place of the slide is chosen.
#pragma once

#include "core/inverse/inverse.hpp"

namespace xr3::inverse {

/// Whether joint 1 slides.
bool has_slide(const Robot& robot);

/// Whether there is a mount or a slide below the arm.
bool is_carried(const Robot& robot);

/// The joints behind mount and slide, without outlines, couplings and tool. Only for their
/// Denavit-Hartenberg rows and homes.
Robot carried_arm(const Robot& robot);

/// From the base frame to frame 0 of carried_arm(). `slide_mm` is ignored without a slide.
Transform carrier_pose(const Robot& robot, double slide_mm);

/// The target in the frame with this pose.
ToolTarget seen_from(const Transform& pose, const ToolTarget& target);

}  // namespace xr3::inverse
