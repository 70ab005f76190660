// The pose for given joint variables, computed once for both text and JSON.
#pragma once

#include <vector>

#include "core/inverse/inverse.hpp"
#include "tools/kin/question.hpp"

namespace xr3 {

/// One motor with the joint (or tool) it drives.
struct KinMotor {
  double variable = 0;    ///< as given in the question, degrees or mm
  Counts count = 0;       ///< nearest motor count, coupling removed
  Counts position = 0;    ///< the resulting position of the joint
  double rounded = 0;     ///< the variable at that position
  Counts past_limit = 0;  ///< distance past a limit in counts; 0 if within
};

struct KinPose {
  std::vector<KinMotor> motors;  ///< the joints' from the base, then the tool's
  std::vector<Transform> links;  ///< T(k-1,k), k = 1...n
  std::vector<Transform> bases;  ///< T(0,k), k = 0...n
  ToolConfiguration w;
  double net_roll_deg = 0;
  double opening_mm = 0;  ///< at the whole count
  bool in_protected_region = false;
  PoseError rounded;  ///< error at the whole counts

  Transform tool() const { return bases.back(); }
};

KinPose kin_pose(const Model& model, const DirectQuestion& question);

}  // namespace xr3
