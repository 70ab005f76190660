// What the robot can reach, for the workcell's dialogue: a place is within reach if the tool tip can be
// there with the hand pointing straight down, within the limits and outside the protected region. Of a
// robot of at most three joints, which cannot choose how the hand points, the tip alone is asked for.
#pragma once

#include <optional>

#include "core/model.hpp"
#include "core/workcell.hpp"

namespace xr3 {

class Reach {
 public:
  explicit Reach(const Robot& robot);

  /// With the hand turned so that the jaws close across or along it, tip in its middle.
  bool has_grasp(const Block& block) const;

  /// With the hand turned any of the four ways along the axes. mm in the base frame.
  bool is_within(double x_mm, double y_mm, double z_mm) const;

  /// Whether the answers come at once: by a closed form, not by numbers from many starts.
  bool is_quick() const { return is_quick_; }

  /// The furthest place straight ahead (y = 0) at a height, in whole centimetres; nothing if there is
  /// none. Only for quick ones.
  std::optional<double> furthest_mm(double z_mm) const;

 private:
  bool is_within(double x_mm, double y_mm, double z_mm, double yaw_deg) const;

  Model model_;
  bool is_quick_;
};

}  // namespace xr3
