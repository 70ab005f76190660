#include "core/inverse/reach.hpp"

#include <algorithm>
#include <cmath>

namespace xr3 {
namespace {

constexpr double kQuarterTurnDeg = 90;
constexpr int kQuarterTurns = 4;
constexpr double kStepMm = 10;
constexpr double kMaxSteps = 400;
constexpr std::size_t kFewJoints = 3;
constexpr int kSlideSteps = 20;

/// The places of the slide to be tried: the soft home, then equal steps over its range.
std::vector<InverseOptions> places_of_slide(const Robot& robot) {
  std::vector<InverseOptions> places(1);
  if (!keeps_slide(robot)) return places;
  const Drive& slide = robot.joints.front().drive;
  for (int i = 0; i <= kSlideSteps; ++i) {
    places.emplace_back().slide_mm = slide.min + (slide.max - slide.min) * i / kSlideSteps;
  }
  return places;
}

}  // namespace

Reach::Reach(const Robot& robot)
    : model_(robot, Workcell{}, Profile::kPaper),
      is_quick_(inverse_method(robot) != InverseMethod::kNumerical),
      places_(places_of_slide(robot)) {}

bool Reach::is_reached(double x_mm, double y_mm, double z_mm, double yaw_deg) const {
  const Eigen::Vector3d p_mm(x_mm, y_mm, z_mm);
  const bool is_free = model_.robot().joints.size() <= kFewJoints;
  const ToolTarget target = is_free ? tip_target(p_mm) : down_target(p_mm, yaw_deg);
  return std::any_of(places_.begin(), places_.end(), [&](const InverseOptions& options) {
    const InverseResult result = solve_inverse(model_, target, options);
    return !result.solutions.empty() && result.solutions.front().is_allowed();
  });
}

bool Reach::has_grasp(const Block& block) const {
  const PointUm& at = block.centroid_um;
  return is_within(mm(at.x), mm(at.y), mm(at.z), degrees(block.yaw_udeg));
}

bool Reach::is_within(double x_mm, double y_mm, double z_mm, double yaw_deg) const {
  for (int turn = 0; turn < kQuarterTurns; ++turn) {
    if (is_reached(x_mm, y_mm, z_mm, yaw_deg + turn * kQuarterTurnDeg)) return true;
  }
  return false;
}

// Each joint adds at most the length of its row, slide included.
double Reach::most_mm() const {
  const Robot& robot = model_.robot();
  double sum = 0;
  for (const Joint& joint : robot.joints) {
    const double d = joint.is_revolute()
                         ? std::abs(joint.dh.d_mm)
                         : std::max(std::abs(joint.drive.min), std::abs(joint.drive.max));
    sum += std::hypot(d, joint.dh.a_mm);
  }
  if (robot.mount) sum += std::hypot(robot.mount->d_mm, robot.mount->a_mm);
  return sum;
}

std::optional<double> Reach::furthest_mm(double z_mm) const {
  const double most = most_mm();
  const double step = std::max(kStepMm, most / kMaxSteps);
  for (double x = std::ceil(most / step) * step; x > 0; x -= step) {
    if (is_within(x, 0, z_mm)) return x;
  }
  return std::nullopt;
}

}  // namespace xr3
