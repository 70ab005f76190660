#include "core/inverse/solvers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace xr3::inverse {
namespace {

constexpr double kSameDeg = 1e-9;
constexpr double kSameMm = 1e-9;
constexpr double kNoSide = 1e-9;  // relative to the elbow's distance from the shoulder-wrist line

}  // namespace

void Candidates::set_free(InverseFreedom freedom) {
  if (std::find(freedoms.begin(), freedoms.end(), freedom) == freedoms.end())
    freedoms.push_back(freedom);
}

void Candidates::refuse(InverseRefusal reason, double mm, double deg) {
  if (refusal != InverseRefusal::kNo && off_mm + off_deg <= mm + deg) return;
  refusal = reason;
  off_mm = mm;
  off_deg = deg;
}

bool is_angle(double deg, double wanted_deg) {
  return std::abs(std::remainder(deg - wanted_deg, 360.0)) < kSameDeg;
}

bool is_quarter(double deg) { return is_angle(deg, 90.0) || is_angle(deg, -90.0); }

bool is_zero(double mm) { return std::abs(mm) < kSameMm; }

bool all_turn(const Robot& robot) {
  return std::all_of(robot.joints.begin(), robot.joints.end(),
                     [](const Joint& joint) { return joint.is_revolute(); });
}

bool ends_in_plain_roll(const Robot& robot) {
  const Joint& last = robot.joints.back();
  return last.is_revolute() && is_zero(last.dh.a_mm) && is_angle(last.dh.alpha_deg, 0);
}

double unit_sin(double twist_deg) { return sin_cos_deg(twist_deg).sin > 0 ? 1.0 : -1.0; }
double unit_cos(double twist_deg) { return sin_cos_deg(twist_deg).cos > 0 ? 1.0 : -1.0; }

// Law of cosines. The sine is computed from factors, which is accurate near the stretched arm, too.
std::vector<TwoLinkPosture> two_link_postures(const TwoLinks& links, const Eigen::Vector2d& wrist,
                                              double tolerance_mm, Candidates& found) {
  const double a = links.first_mm;
  const double b = links.second_mm;
  const double reach = wrist.norm();
  const double longest = std::abs(a) + std::abs(b);
  const double shortest = std::abs(std::abs(a) - std::abs(b));
  const double slack = std::max(tolerance_mm, kSameMm);
  if (reach > longest + slack) {
    found.refuse(InverseRefusal::kTooFar, reach - longest, 0);
    return {};
  }
  if (reach < shortest - slack) {
    found.refuse(InverseRefusal::kTooNear, shortest - reach, 0);
    return {};
  }
  const bool at_edge = reach > longest - kSameMm || reach < shortest + kSameMm;
  const double product =
      (longest - reach) * (longest + reach) * (reach - shortest) * (reach + shortest);
  const double sine = at_edge ? 0 : std::sqrt(product) / (2 * std::abs(a * b));
  const double cosine = std::clamp((reach * reach - a * a - b * b) / (2 * a * b), -1.0, 1.0);
  const double second = at_edge ? (cosine > 0 ? 0 : kPi) : std::atan2(sine, cosine);
  if (reach < kSameMm) {
    found.set_free(InverseFreedom::kFolded);
    return {{links.free_first_rad, second}};
  }
  std::vector<TwoLinkPosture> postures;
  for (const double bend : {second, -second}) {
    const double inner = std::atan2(b * std::sin(bend), a + b * std::cos(bend));
    postures.push_back({std::atan2(wrist.y(), wrist.x()) - inner, bend});
    if (at_edge) break;
  }
  return postures;
}

std::string elbow_name(const Eigen::Matrix3d& rotation, const TwoLinks& links,
                       const TwoLinkPosture& at, const Eigen::Vector3d& wrist) {
  const double second_rad = at.second_rad;
  const Eigen::Vector3d first(std::cos(at.first_rad), std::sin(at.first_rad), 0);
  const Eigen::Vector3d elbow = rotation * first * links.first_mm;
  const Eigen::Vector3d line = wrist.normalized();
  const Eigen::Vector3d aside = elbow - line * elbow.dot(line);
  if (std::abs(std::sin(second_rad)) < kNoSide) {
    return std::cos(second_rad) > 0 ? "elbow straight" : "elbow folded";
  }
  const double side = kNoSide * aside.norm();
  if (std::abs(aside.z()) > side) return aside.z() > 0 ? "elbow up" : "elbow down";
  const double left = line.cross(aside).z();
  if (std::abs(left) > side) return left > 0 ? "elbow left" : "elbow right";
  return second_rad > 0 ? "elbow +" : "elbow -";
}

void add_last(const Robot& robot, const ToolTarget& target, JointVariables& variables) {
  if (target.kind == TargetKind::kPointing) {
    variables.push_back(target.last);
    return;
  }
  const Transform before = base_transforms_at(robot, variables).back();
  const Eigen::Matrix3d turn = before.block<3, 3>(0, 0).transpose() * target.rotation;
  variables.push_back(to_deg(std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1))));
}

}  // namespace xr3::inverse
