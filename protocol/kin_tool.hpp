// The pose that joint variables make, worked out once for text and JSON. It prints nothing.
#pragma once

#include <vector>

#include "core/inverse.hpp"
#include "protocol/kin_question.hpp"

namespace xr3 {

/// One motor with the joint (or tool) it drives.
struct KinMotor {
  double variable = 0;    ///< as asked, degrees or mm
  Counts count = 0;       ///< nearest motor count, coupling taken out
  Counts position = 0;    ///< the joint's position that follows
  double rounded = 0;     ///< the variable at that position
  Counts past_limit = 0;  ///< counts; 0 within
};

struct KinPose {
  std::vector<KinMotor> motors;  ///< the joints' from the base, then the tool's
  std::vector<Transform> links;  ///< T(k-1,k), k = 1...n
  std::vector<Transform> bases;  ///< T(0,k), k = 0...n
  ToolConfiguration w;
  double net_roll_deg = 0;
  double opening_mm = 0;  ///< at the whole count
  bool in_protected_region = false;
  PoseError rounded;  ///< of the whole counts

  Transform tool() const { return bases.back(); }
};

KinPose kin_pose(const Model& model, const DirectQuestion& question);

}  // namespace xr3
