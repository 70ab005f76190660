// Numerical inverse kinematics for any chain: damped least squares (Levenberg-Marquardt) from the
// soft home and from points of a Halton sequence over the joints' ranges. The starts are fixed, so
// the result is deterministic. Solutions that no start leads to are missed.
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/inverse/solvers.hpp"

namespace xr3::inverse {
namespace {

constexpr int kStarts = 96;
constexpr int kMaxSteps = 80;
constexpr std::size_t kMaxOfFamily = 8;  ///< solutions listed if there are infinitely many
constexpr double kDone = 1e-13;          ///< residual at which the descent ends, in arm lengths
constexpr double kRankThreshold = 1e-7;
constexpr double kSameDegOrMm = 1e-4;
constexpr std::array<int, kMaxJoints> kBases{2, 3, 5, 7, 11, 13, 17};

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// The weight of a radian in mm: the mean length of a link, which makes tip and rotation errors
/// comparable.
double arm_length_mm(const Robot& robot) {
  double sum = 0;
  for (const Joint& joint : robot.joints) sum += std::abs(joint.dh.a_mm) + std::abs(joint.dh.d_mm);
  return std::max(sum / static_cast<double>(robot.joints.size()), 1.0);
}

/// The least-squares problem: unknowns in radians or arm lengths, residuals in arm lengths or
/// radians.
class LeastSquares {
 public:
  LeastSquares(const Robot& robot, const ToolTarget& target)
      : robot_(robot), target_(target), length_mm_(arm_length_mm(robot)) {
    const bool last_given = target.kind == TargetKind::kPointing;
    unknowns_ = static_cast<Eigen::Index>(robot.joints.size()) - (last_given ? 1 : 0);
    rows_ = target.kind == TargetKind::kTip ? 3 : 6;
  }

  Eigen::Index unknowns() const { return unknowns_; }

  Vector residual(const JointVariables& variables) const {
    const Transform pose = tool_transform_at(robot_, variables);
    Vector rest(rows_);
    rest.head<3>() = (target_.p_mm - pose.block<3, 1>(0, 3)) / length_mm_;
    if (rows_ == 6) rest.tail<3>() = turn_left(pose.block<3, 3>(0, 0));
    return rest;
  }

  Matrix slopes(const JointVariables& variables) const {
    Matrix columns = jacobian(robot_, base_transforms_at(robot_, variables));
    columns.topRows(3) /= length_mm_;
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
      if (!robot_.joints[static_cast<std::size_t>(k)].is_revolute()) columns.col(k) *= length_mm_;
    }
    if (target_.kind == TargetKind::kPointing) {
      const Eigen::Vector3d z = tool_transform_at(robot_, variables).block<3, 1>(0, 2);
      columns.bottomRows(3) -= z * (z.transpose() * columns.bottomRows(3)).eval();
    }
    return columns.topLeftCorner(rows_, unknowns_);
  }

  JointVariables stepped(JointVariables variables, const Vector& step) const {
    for (Eigen::Index k = 0; k < unknowns_; ++k) {
      const auto own = static_cast<std::size_t>(k);
      variables[own] += robot_.joints[own].is_revolute() ? to_deg(step[k]) : step[k] * length_mm_;
    }
    return variables;
  }

 private:
  /// The rotation vector from the tool's current to its wanted orientation, in the base frame.
  Eigen::Vector3d turn_left(const Eigen::Matrix3d& rotation) const {
    if (target_.kind == TargetKind::kPointing) {
      const Eigen::Vector3d z = rotation.col(2);
      const Eigen::Vector3d axis = z.cross(target_.approach());
      const double sine = axis.norm();
      if (sine == 0) return Eigen::Vector3d::Zero();
      return axis * (std::atan2(sine, z.dot(target_.approach())) / sine);
    }
    const Eigen::AngleAxisd turn(Eigen::Quaterniond(target_.rotation * rotation.transpose()));
    return turn.axis() * std::remainder(turn.angle(), 2 * kPi);
  }

  const Robot& robot_;
  const ToolTarget& target_;
  double length_mm_;
  Eigen::Index unknowns_ = 0;
  Eigen::Index rows_ = 6;
};

JointVariables descend(const LeastSquares& problem, JointVariables at) {
  double damping = 1e-3;
  Vector rest = problem.residual(at);
  for (int step = 0; step < kMaxSteps && rest.norm() > kDone && damping < 1e9; ++step) {
    const Matrix slopes = problem.slopes(at);
    Matrix normal = slopes.transpose() * slopes;
    normal.diagonal().array() += damping;
    const JointVariables next = problem.stepped(at, normal.ldlt().solve(slopes.transpose() * rest));
    const Vector next_rest = problem.residual(next);
    const bool better = next_rest.squaredNorm() < rest.squaredNorm();
    damping = better ? std::max(damping * 0.1, 1e-15) : damping * 10;
    if (!better) continue;
    at = next;
    rest = next_rest;
  }
  return at;
}

double halton(int index, int base) {
  double value = 0;
  double part = 1.0 / base;
  for (; index > 0; index /= base, part /= base) value += part * (index % base);
  return value;
}

/// Start values: number 0 is `first`, the others lie within the joints' limits and, for revolute
/// joints, within half a turn of the home.
JointVariables start(const Robot& robot, const ToolTarget& target, const JointVariables& first,
                     int index) {
  JointVariables variables = first;
  for (std::size_t k = 0; index > 0 && k < variables.size(); ++k) {
    const Drive& drive = robot.joints[k].drive;
    const double half_turn = robot.joints[k].is_revolute() ? 180.0 : drive.max - drive.min;
    const double low = std::max(drive.min, drive.home - half_turn);
    const double high = std::min(drive.max, drive.home + half_turn);
    variables[k] = low + (high - low) * halton(index, kBases[k]);
  }
  if (target.kind == TargetKind::kPointing) variables.back() = target.last;
  return variables;
}

bool is_same(const Robot& robot, const JointVariables& one, const JointVariables& other) {
  for (std::size_t k = 0; k < one.size(); ++k) {
    const double apart = one[k] - other[k];
    const double distance = robot.joints[k].is_revolute() ? std::remainder(apart, 360.0) : apart;
    if (std::abs(distance) > kSameDegOrMm) return false;
  }
  return true;
}

bool is_known(const Robot& robot, const Candidates& found, const JointVariables& variables) {
  return std::any_of(found.list.begin(), found.list.end(), [&](const Candidate& known) {
    return is_same(robot, known.variables, variables);
  });
}

bool can_move_in_place(const LeastSquares& problem, const JointVariables& variables) {
  Eigen::ColPivHouseholderQR<Matrix> decomposition(problem.slopes(variables));
  decomposition.setThreshold(kRankThreshold);
  return decomposition.rank() < problem.unknowns();
}

}  // namespace

Candidates solve_numerically(const Robot& robot, const ToolTarget& target,
                             const InverseOptions& options) {
  Candidates found;
  const LeastSquares problem(robot, target);
  const JointVariables first = options.near.value_or(home_variables(robot));
  const int starts = options.near ? 1 : kStarts;
  double least = std::numeric_limits<double>::infinity();
  for (int index = 0; index < starts; ++index) {
    if (!found.freedoms.empty() && found.list.size() == kMaxOfFamily) break;
    const JointVariables end = descend(problem, start(robot, target, first, index));
    const PoseError error = pose_error(robot, target, end);
    const double rest = problem.residual(end).norm();
    if (error.mm > options.tolerance_mm || error.deg > options.tolerance_deg) {
      if (rest < least) {
        found.refusal = InverseRefusal::kNotFound;
        found.off_mm = error.mm;
        found.off_deg = error.deg;
        least = rest;
      }
      continue;
    }
    if (is_known(robot, found, end)) continue;
    if (can_move_in_place(problem, end)) found.set_free(InverseFreedom::kMoreThanNeeded);
    found.list.push_back({end, "solution " + std::to_string(found.list.size() + 1)});
  }
  return found;
}

}  // namespace xr3::inverse
