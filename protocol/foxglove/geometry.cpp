#include "protocol/foxglove/geometry.hpp"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "protocol/json/values.hpp"
#include "protocol/scene/colors.hpp"

namespace xr3::foxglove {
namespace {

constexpr Nanoseconds kSecond = 1'000'000'000;
// A nanometre, and an angle that moves a point at 1 m by as little.
constexpr int kDecimals = 9;
constexpr int kColorDecimals = 3;

Json metres(double mm) { return rounded(mm / 1000.0, kDecimals); }

}  // namespace

Json time_json(Nanoseconds time) {
  return Json::object({{"sec", time / kSecond}, {"nsec", time % kSecond}});
}

Json metres_json(const Eigen::Vector3d& mm) {
  return Json::object({{"x", metres(mm.x())}, {"y", metres(mm.y())}, {"z", metres(mm.z())}});
}

Json quaternion_json(const Transform& transform) {
  const Eigen::Matrix3d rotation = transform.block<3, 3>(0, 0);
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  return Json::object({{"x", rounded(q.x(), kDecimals)},
                       {"y", rounded(q.y(), kDecimals)},
                       {"z", rounded(q.z(), kDecimals)},
                       {"w", rounded(q.w(), kDecimals)}});
}

Json pose_json(const Transform& transform) {
  return Json::object({{"position", metres_json(transform.block<3, 1>(0, 3))},
                       {"orientation", quaternion_json(transform)}});
}

Json color_json(int index) {
  const auto [red, green, blue] = solid_rgb(index);
  const auto part = [](std::uint8_t value) { return rounded(value / 255.0, kColorDecimals); };
  return Json::object({{"r", part(red)}, {"g", part(green)}, {"b", part(blue)}, {"a", 1.0}});
}

}  // namespace xr3::foxglove
