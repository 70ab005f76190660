// The joint of a link in metres and radians, as URDF and MJCF have it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/scene/links.hpp"

namespace xr3 {

struct ExportedJoint {
  std::string name;         ///< label of the motor: `F`; of a second finger `A_2`
  std::string mimics;       ///< name of the joint with the same motor; empty if there is none
  bool is_endless = false;  ///< turns without stops
  double low = 0;           ///< limits, m or rad
  double high = 0;
  double home = 0;   ///< value at the soft home, m or rad
  double speed = 0;  ///< m/s or rad/s at the speed of the motor
};

/// The joint between a link and its parent; nullopt if it is fixed.
std::optional<ExportedJoint> joint_of(const Model& model, const std::vector<SceneLink>& links,
                                      std::size_t link);

}  // namespace xr3
