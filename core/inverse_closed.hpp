// The closed forms behind inverse.hpp, and what they share. Angles are radians inside, degrees in the
// candidates that come out. They know neither counts nor limits.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/inverse.hpp"

namespace xr3::inverse {

struct Candidate {
  JointVariables variables;
  std::string branch;
};

/// What a method finds: candidates, or why there are none.
struct Candidates {
  std::vector<Candidate> list;
  std::vector<InverseFreedom> freedoms;  ///< each at most once
  InverseRefusal refusal = InverseRefusal::kNo;
  double off_mm = 0;
  double off_deg = 0;

  void set_free(InverseFreedom freedom);
  /// Of several branches' reasons the nearest miss stays. It counts only while the list is empty.
  void refuse(InverseRefusal reason, double mm, double deg);
};

bool is_five_axis_arm(const Robot& robot);
bool is_scara(const Robot& robot);
bool is_six_axis_arm(const Robot& robot);

Candidates solve_five_axis_arm(const Robot& robot, const ToolTarget& target,
                               const InverseOptions& options);
Candidates solve_scara(const Robot& robot, const ToolTarget& target, const InverseOptions& options);
Candidates solve_six_axis_arm(const Robot& robot, const ToolTarget& target,
                              const InverseOptions& options);
Candidates solve_numerically(const Robot& robot, const ToolTarget& target,
                             const InverseOptions& options);

bool is_angle(double deg, double wanted_deg);  ///< but for full turns
bool is_quarter(double deg);                   ///< +-90 but for full turns
bool is_zero(double mm);
bool all_turn(const Robot& robot);
/// The last row adds nothing but roll and length: a = 0 and alpha = 0.
bool ends_in_plain_roll(const Robot& robot);

inline double to_deg(double rad) { return rad * 180.0 / kPi; }
inline double to_rad(double deg) { return deg * kPi / 180.0; }
double unit_sin(double twist_deg);  ///< of a quarter turn: +1 or -1
double unit_cos(double twist_deg);  ///< of 0 or a half turn: +1 or -1

/// Two links in a plane, each angle measured from the link before.
struct TwoLinks {
  double first_mm;
  double second_mm;
  double free_first_rad;  ///< where the first stands if the wrist is on the shoulder
};

struct TwoLinkPosture {
  double first_rad;
  double second_rad;
};

/// Both postures that put the wrist there, one where they coincide, none where it cannot be; what is
/// out of reach by no more than the tolerance is brought to the edge.
std::vector<TwoLinkPosture> two_link_postures(const TwoLinks& links, const Eigen::Vector2d& wrist,
                                              double tolerance_mm, Candidates& found);

/// `elbow up`, `down`, `left`, `right` (seen from above, looking from the shoulder to the wrist),
/// `straight` or `folded`. Vectors from the shoulder, in the base frame.
std::string elbow_name(const Eigen::Vector3d& elbow, const Eigen::Vector3d& wrist,
                       double second_rad);

/// Adds the last joint's variable: the target's own, or what turns the tool as the target wants it.
void add_last(const Robot& robot, const ToolTarget& target, JointVariables& variables);

}  // namespace xr3::inverse
