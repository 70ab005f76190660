#include "tools/export/inertia.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "tools/export/numbers.hpp"

namespace xr3 {
namespace {

constexpr double kDensity = 300;  ///< kg/m3
constexpr double kLeastMassKg = 0.05;
constexpr double kLeastSizeMm = 10;

Eigen::AlignedBox3d box_around(const Solid& solid) {
  Eigen::AlignedBox3d box;
  for (const Triangle& face : solid.faces)
    for (const Eigen::Vector3d& p : face) box.extend(p);
  return box.isEmpty() ? Eigen::AlignedBox3d(Eigen::Vector3d::Zero()) : box;
}

}  // namespace

BoxInertia box_inertia(const Solid& solid) {
  const Eigen::AlignedBox3d box = box_around(solid);
  const Eigen::Vector3d size = kMetresPerMm * box.sizes().cwiseMax(kLeastSizeMm);
  const double mass = std::max(kLeastMassKg, kDensity * size.prod());
  const Eigen::Vector3d squares = size.cwiseProduct(size);
  const Eigen::Vector3d moments = mass / 12 * (Eigen::Vector3d::Constant(squares.sum()) - squares);
  return {box.center(), mass, moments};
}

}  // namespace xr3
