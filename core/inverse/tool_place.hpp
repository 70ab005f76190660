// Places of the tool as a person chooses them who jogs or drags it, and the motor counts for them:
// the tip and two angles, of which all that is not wanted otherwise stays as it is. Answers with
// the reason and the nearest place if the tool cannot be there.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "core/inverse/inverse.hpp"
#include "core/model.hpp"

namespace xr3 {

/// A place of the tool in the arm's own base frame, in mm and degrees; that frame stands behind the
/// robot's mount and its slide.
struct ToolPlace {
  Eigen::Vector3d tip_mm = Eigen::Vector3d::Zero();
  /// The direction of the hand above the horizontal, in a vertical plane through the tip: 0 points
  /// away from the base axis, -90 straight down.
  double pitch_deg = -90;
  /// The yaw of the jaws: the net roll with the hand straight down, and the same jaws tilted.
  double roll_deg = 0;
  /// The distance of that plane from the base axis; 0 for an arm without an offset at its shoulder.
  double offset_mm = 0;
};

/// The parts of a place that are wanted; the tip is in the base frame.
struct WantedPlace {
  Eigen::Vector3d tip_mm;
  std::optional<double> pitch_deg;  ///< default: as at the start
  std::optional<double> roll_deg;   ///< default: as at the start
  std::string branch;               ///< such as "front, elbow up"; any if empty
};

/// Motor counts by index; those of the tool and the carousel are as at the start.
struct ReachedPlace {
  Positions counts{};
  std::string branch;
  Eigen::Vector3d tip_mm;  ///< at these counts, in the base frame
};

/// The reason why the tool cannot be at a place.
enum class Obstacle : std::uint8_t {
  kTooFar,
  kTooNear,
  kDirection,  ///< the arm has too few joints to point the hand there
  kLimit,
  kProtectedRegion,
  kWorkSurface,
  kNotFound,  ///< the numerical method found no solution from the start
  kNoBranch,  ///< no solution has the wanted branch
};

struct Unreachable {
  Obstacle obstacle = Obstacle::kNotFound;
  /// mm, or degrees for kDirection and for a limit of a joint that turns; 0 for kProtectedRegion
  /// and kNoBranch.
  double amount = 0;
  int joint = 0;                        ///< index of the joint at its limit
  std::optional<ReachedPlace> nearest;  ///< none if not even the start can be kept
};

/// The place of the tool at these positions.
ToolPlace place_at(const Model& model, const Positions& positions);

/// The counts for a wanted place, with the shortest travel from the motor counts `start`. A tool
/// that is below the work surface at the start may be below it. The nearest place is straight above
/// the wanted one if that is below the work surface; if not, on the way there from the start. Takes
/// at most some 20 times as long as solve_inverse().
std::variant<ReachedPlace, Unreachable> reach_place(const Model& model, const Positions& start,
                                                    const WantedPlace& wanted);

}  // namespace xr3
