// The robot's reach, for checks of a workcell. A point is within reach if the tool tip can be
// there with the hand straight down, within the joint limits and outside the protected region. A
// robot with at most three joints cannot choose the hand's orientation, so only its tip is
// considered. A slide may be anywhere within its limits.
#pragma once

#include <optional>
#include <vector>

#include "core/inverse/inverse.hpp"
#include "core/model.hpp"
#include "core/workcell.hpp"

namespace xr3 {

class Reach {
 public:
  explicit Reach(const Robot& robot);

  /// Whether the tip reaches the block's centre with the jaws across or along the block.
  bool has_grasp(const Block& block) const;

  /// Whether the tip reaches the point with the hand in any of four orientations a quarter turn
  /// apart, one of them at this yaw. mm in the base frame.
  bool is_within(double x_mm, double y_mm, double z_mm, double yaw_deg = 0) const;

  /// Whether the inverse kinematics has a closed form. If not, each call takes long.
  bool is_quick() const { return is_quick_; }

  /// An upper bound of the tip's distance from the base frame's origin, in mm.
  double most_mm() const;

  /// The maximum x within reach at y = 0 and this height, in steps of 10 mm, or of a 400th of
  /// most_mm() if that is more; nullopt if there is none. Call it only if is_quick().
  std::optional<double> furthest_mm(double z_mm) const;

 private:
  bool is_reached(double x_mm, double y_mm, double z_mm, double yaw_deg) const;

  Model model_;
  bool is_quick_;
  std::vector<InverseOptions> places_;  ///< places of the slide; one element without a slide
};

}  // namespace xr3
