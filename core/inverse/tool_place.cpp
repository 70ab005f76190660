#include "core/inverse/tool_place.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/carousel.hpp"
#include "core/inverse/solvers.hpp"
#include "core/stall.hpp"

namespace xr3 {
namespace {

using Eigen::Vector3d;
using inverse::to_deg;
using inverse::to_rad;
constexpr double kUpright = 1e-4;      // the sine below which a hand has no direction to a side
constexpr std::size_t kMaxForTip = 3;  // joints of a robot that cannot choose a direction
constexpr int kHalvings = 12;
constexpr int kLifts = 4;

/// From the base frame to the arm's own: behind mount and slide.
Transform arm_frame(const Model& model, const Positions& positions) {
  return base_transforms(model, positions)[static_cast<std::size_t>(model.slide_count())];
}

Vector3d into(const Transform& frame, const Vector3d& point_mm) {
  return frame.block<3, 3>(0, 0).transpose() * (point_mm - frame.block<3, 1>(0, 3));
}

Eigen::Matrix3d about_z(double deg) {
  return Eigen::AngleAxisd(to_rad(deg), Vector3d::UnitZ()).toRotationMatrix();
}

/// The azimuth in degrees of the hand's plane, at a tip on one side of it.
double plane_deg(const Vector3d& tip_mm, double offset_mm) {
  const double radius = std::hypot(tip_mm.x(), tip_mm.y());
  const double sine = radius > 0 ? std::clamp(offset_mm / radius, -1.0, 1.0) : 0;
  return to_deg(std::atan2(tip_mm.y(), tip_mm.x()) + std::asin(sine));
}

/// Turns a hand that points down to the pitch, in the plane with this azimuth.
Eigen::Matrix3d tilt(double plane_deg, double pitch_deg) {
  const Eigen::AngleAxisd up(to_rad(-90 - pitch_deg), Vector3d::UnitY());
  return about_z(plane_deg) * up.toRotationMatrix() * about_z(-plane_deg);
}

const Eigen::Matrix3d& pointing_down() {
  static const Eigen::Matrix3d down = down_target(Vector3d::Zero(), 0).rotation;
  return down;
}

ToolTarget target_of(const Model& model, const Transform& arm, const ToolPlace& place) {
  const Vector3d tip = arm.block<3, 3>(0, 0) * place.tip_mm + arm.block<3, 1>(0, 3);
  if (model.robot().joints.size() <= kMaxForTip) return tip_target(tip);
  const double plane = plane_deg(place.tip_mm, place.offset_mm);
  const Eigen::Matrix3d hand =
      tilt(plane, place.pitch_deg) * about_z(place.roll_deg) * pointing_down();
  return pose_target(tip, arm.block<3, 3>(0, 0) * hand);
}

/// The place on the way from one to another: 0 is the first, 1 the second.
ToolPlace between(const ToolPlace& from, const ToolPlace& to, double part) {
  const auto mixed = [part](const auto& a, const auto& b) { return (a + part * (b - a)).eval(); };
  const auto turned = [part](double a, double b) {
    return a + part * std::remainder(b - a, 360.0);
  };
  return {mixed(from.tip_mm, to.tip_mm), turned(from.pitch_deg, to.pitch_deg),
          turned(from.roll_deg, to.roll_deg),
          from.offset_mm + part * (to.offset_mm - from.offset_mm)};
}

/// Solves for places of the tool of a robot that starts somewhere.
class Search {
 public:
  Search(const Model& model, const Positions& start, const WantedPlace& wanted)
      : model_(model), start_(start), branch_(wanted.branch) {
    const Positions positions = positions_at(start);
    arm_ = arm_frame(model, positions);
    from_ = place_at(model, positions);
    to_ = from_;
    to_.tip_mm = into(arm_, wanted.tip_mm);
    to_.pitch_deg = wanted.pitch_deg.value_or(from_.pitch_deg);
    to_.roll_deg = wanted.roll_deg.value_or(from_.roll_deg);
    may_be_below_ = is_below_surface(model, tool_tip(model, positions));
    options_.near = variables_at(model, positions);
    options_.slide_mm = options_.near->front();
  }

  std::variant<ReachedPlace, Unreachable> run() const {
    auto found = reach(to_);
    if (auto* no = std::get_if<Unreachable>(&found))
      no->nearest =
          no->obstacle == Obstacle::kWorkSurface ? nearest_above(no->amount) : nearest_on_way(to_);
    return found;
  }

 private:
  Positions positions_at(const Positions& motors) const {
    Motors all{};
    for (std::size_t i = 0; i < motors.size(); ++i) all[i].count = motors[i];
    return positions(model_, all);
  }

  std::variant<ReachedPlace, Unreachable> reach(const ToolPlace& place) const {
    const InverseResult result = solve_inverse(model_, target_of(model_, arm_, place), options_);
    if (result.solutions.empty()) return refusal_of(result);
    std::optional<Unreachable> first;
    for (const InverseSolution& solution : result.solutions) {
      if (!branch_.empty() && solution.branch != branch_) continue;
      const std::optional<Unreachable> obstacle = obstacle_of(solution);
      if (!obstacle) return reached(solution);
      if (!first) first = obstacle;
    }
    return first.value_or(Unreachable{Obstacle::kNoBranch, 0, 0, std::nullopt});
  }

  ReachedPlace reached(const InverseSolution& solution) const {
    ReachedPlace place{start_, solution.branch, Vector3d::Zero()};
    for (int k = 0; k < model_.joint_count(); ++k) {
      const auto own = static_cast<std::size_t>(k);
      place.counts[own] = solution.counts.motors[own];
    }
    const PointUm tip = tool_tip(model_, solution.counts.positions);
    place.tip_mm = {mm(tip.x), mm(tip.y), mm(tip.z)};
    return place;
  }

  std::optional<Unreachable> obstacle_of(const InverseSolution& solution) const {
    if (!solution.beyond.empty()) {
      const auto most = std::max_element(
          solution.beyond.begin(), solution.beyond.end(),
          [](const LimitExcess& a, const LimitExcess& b) { return a.amount < b.amount; });
      return Unreachable{Obstacle::kLimit, most->amount, most->joint, std::nullopt};
    }
    if (solution.in_protected_region)
      return Unreachable{Obstacle::kProtectedRegion, 0, 0, std::nullopt};
    const PointUm tip = tool_tip(model_, solution.counts.positions);
    if (may_be_below_ || !is_below_surface(model_, tip)) return std::nullopt;
    return Unreachable{Obstacle::kWorkSurface, mm(surface_um(model_, tip.x, tip.y) - tip.z), 0,
                       std::nullopt};
  }

  static Unreachable refusal_of(const InverseResult& result) {
    switch (result.refusal) {
      case InverseRefusal::kTooFar: return {Obstacle::kTooFar, result.off_mm, 0, std::nullopt};
      case InverseRefusal::kTooNear:
      case InverseRefusal::kTooNearAxis:
        return {Obstacle::kTooNear, result.off_mm, 0, std::nullopt};
      case InverseRefusal::kApproachOutOfPlane:
      case InverseRefusal::kApproachNotVertical:
        return {Obstacle::kDirection, result.off_deg, 0, std::nullopt};
      default: return {Obstacle::kNotFound, result.off_mm, 0, std::nullopt};
    }
  }

  /// The counts round the tip up or down, so one lift may leave it a little below.
  std::optional<ReachedPlace> nearest_above(double depth_mm) const {
    ToolPlace place = to_;
    for (int i = 0; i < kLifts; ++i) {
      place.tip_mm += arm_.block<3, 3>(0, 0).transpose() * Vector3d(0, 0, depth_mm);
      auto found = reach(place);
      if (auto* there = std::get_if<ReachedPlace>(&found)) return std::move(*there);
      const auto& no = std::get<Unreachable>(found);
      if (no.obstacle != Obstacle::kWorkSurface) break;
      depth_mm = no.amount;
    }
    return nearest_on_way(place);
  }

  std::optional<ReachedPlace> nearest_on_way(const ToolPlace& to) const {
    std::optional<ReachedPlace> nearest;
    double good = 0;
    double bad = 1;
    for (int i = 0; i <= kHalvings; ++i) {
      const double part = i == 0 ? 0 : (good + bad) / 2;
      auto found = reach(between(from_, to, part));
      auto* there = std::get_if<ReachedPlace>(&found);
      if (there == nullptr && i == 0) return std::nullopt;
      (there != nullptr ? good : bad) = part;
      if (there != nullptr) nearest = std::move(*there);
    }
    return nearest;
  }

  const Model& model_;
  const Positions& start_;
  const std::string& branch_;
  Transform arm_;
  ToolPlace from_;
  ToolPlace to_;
  bool may_be_below_ = false;
  InverseOptions options_;
};

}  // namespace

ToolPlace place_at(const Model& model, const Positions& positions) {
  const Transform arm = arm_frame(model, positions);
  const Transform tool = tool_transform(model, positions);
  const Eigen::Matrix3d hand = arm.block<3, 3>(0, 0).transpose() * tool.block<3, 3>(0, 0);
  ToolPlace place;
  place.tip_mm = into(arm, tool.block<3, 1>(0, 3));
  Vector3d side(hand(0, 2), hand(1, 2), 0);
  const Vector3d out(place.tip_mm.x(), place.tip_mm.y(), 0);
  if (side.norm() >= kUpright) {
    side = side.dot(out) < 0 ? Vector3d(-side.normalized()) : Vector3d(side.normalized());
    place.offset_mm = out.cross(side).z();
  } else {
    side = Vector3d::Zero();
  }
  place.pitch_deg = to_deg(std::atan2(hand(2, 2), hand.col(2).dot(side)));
  const double plane = plane_deg(place.tip_mm, place.offset_mm);
  const Eigen::Matrix3d level =
      tilt(plane, place.pitch_deg).transpose() * hand * pointing_down().transpose();
  place.roll_deg = to_deg(std::atan2(level(1, 0), level(0, 0)));
  return place;
}

std::variant<ReachedPlace, Unreachable> reach_place(const Model& model, const Positions& start,
                                                    const WantedPlace& wanted) {
  return Search(model, start, wanted).run();
}

}  // namespace xr3
