// The solvers behind inverse.hpp and their shared functions. Angles are in radians internally and
// in degrees in the candidates. Counts and limits are not considered here.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/inverse/inverse.hpp"

namespace xr3::inverse {

/// The Denavit-Hartenberg row of joint k, counted from 1 at the base.
inline const DhRow& row(const Robot& robot, std::size_t k) { return robot.joints[k - 1].dh; }

struct Candidate {
  JointVariables variables;
  std::string branch;
};

/// The result of a method: candidates, or the reason why there are none.
struct Candidates {
  std::vector<Candidate> list;
  std::vector<InverseFreedom> freedoms;  ///< no duplicates
  InverseRefusal refusal = InverseRefusal::kNo;
  double off_mm = 0;
  double off_deg = 0;

  void set_free(InverseFreedom freedom);
  /// Keeps the reason with the smallest error of all branches. Used only if the list stays empty.
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

bool is_angle(double deg, double wanted_deg);  ///< modulo full turns
bool is_quarter(double deg);                   ///< +-90 modulo full turns
bool is_zero(double mm);
bool all_turn(const Robot& robot);
/// The last joint is revolute with a = 0 and alpha = 0: it adds only roll and length.
bool ends_in_plain_roll(const Robot& robot);

inline double to_deg(double rad) { return rad * 180.0 / kPi; }
inline double to_rad(double deg) { return deg * kPi / 180.0; }
double unit_sin(double twist_deg);  ///< sine of a quarter turn: +1 or -1
double unit_cos(double twist_deg);  ///< cosine of 0 or a half turn: +1 or -1

/// Two links in a plane. Each angle is relative to the previous link.
struct TwoLinks {
  double first_mm;
  double second_mm;
  double free_first_rad;  ///< angle of the first link if the wrist is on the shoulder
};

struct TwoLinkPosture {
  double first_rad;
  double second_rad;
};

/// Both postures that put the wrist there; one if they coincide, none if it is out of reach. A
/// wrist that is out of reach by at most the tolerance is moved to the edge.
std::vector<TwoLinkPosture> two_link_postures(const TwoLinks& links, const Eigen::Vector2d& wrist,
                                              double tolerance_mm, Candidates& found);

/// A name for the posture: `elbow up`, `down`, `left`, `right` (seen from above, looking from the
/// shoulder to the wrist), `straight` or `folded`; `+` or `-` if none of these applies. `rotation`
/// is that of the links' frame; `wrist` begins at the shoulder and is in the base frame.
std::string elbow_name(const Eigen::Matrix3d& rotation, const TwoLinks& links,
                       const TwoLinkPosture& at, const Eigen::Vector3d& wrist);

/// Appends the last joint's variable: the one that the target gives, or the one that turns the tool
/// to the target's rotation.
void add_last(const Robot& robot, const ToolTarget& target, JointVariables& variables);

}  // namespace xr3::inverse
