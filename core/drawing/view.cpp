#include "core/drawing/view.hpp"

#include <Eigen/Geometry>

namespace xr3 {

View view_along(const ViewVector& vector) {
  const bool is_vertical = vector.x == 0 && vector.y == 0;
  const Eigen::Vector3d upwards = is_vertical ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d toward = Eigen::Vector3d(vector.x, vector.y, vector.z).normalized();
  const Eigen::Vector3d right = upwards.cross(toward).normalized();
  return {right, toward.cross(right), toward};
}

Eigen::Vector2d projected(const View& view, const Eigen::Vector3d& p_mm) {
  return {view.right.dot(p_mm), view.up.dot(p_mm)};
}

Extents view_extents(const View& view, const Workspace& workspace, double behind_mm) {
  const Eigen::Vector2d back = projected(view, {-behind_mm, 0, 0});
  Extents extents{back, back};
  for (const Eigen::Vector3d& corner :
       {Eigen::Vector3d(mm(workspace.x_um), 0, 0), Eigen::Vector3d(0, mm(workspace.y_um), 0),
        Eigen::Vector3d(0, -mm(workspace.y_um), 0), Eigen::Vector3d(0, 0, mm(workspace.z_um))}) {
    const Eigen::Vector2d p = projected(view, corner);
    extents.low = extents.low.cwiseMin(p);
    extents.high = extents.high.cwiseMax(p);
  }
  return extents;
}

}  // namespace xr3
