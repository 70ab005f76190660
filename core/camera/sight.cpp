#include "core/camera/sight.hpp"

#include <algorithm>
#include <cassert>

#include "core/camera.hpp"
#include "core/grasp.hpp"

namespace xr3 {
namespace {

/// The quotient rounded to nearest, halves away from zero. Precondition: divisor > 0.
Micrometres rounded(Micrometres number, Micrometres divisor) {
  assert(divisor > 0);
  const Micrometres half = divisor / 2;
  return (number < 0 ? number - half : number + half) / divisor;
}

/// Projects a corner onto the work surface, `height_um` below the camera.
SurfacePoint seen_from(const PointUm& eye, Micrometres height_um, const PointUm& corner) {
  const Micrometres depth = std::max(eye.z - corner.z, kNearestSightUm);
  return {eye.y + rounded((corner.y - eye.y) * height_um, depth),
          eye.x + rounded((corner.x - eye.x) * height_um, depth)};
}

bool is_seen(const Camera& camera, const BlockCorners& corners) {
  return camera.projection == Projection::kOrthographic ||
         std::any_of(corners.begin(), corners.end(), [&camera](const PointUm& corner) {
           return camera.location_um.z - corner.z > kNearestSightUm;
         });
}

BoxCorners on_surface(const Workcell& workcell, const BlockCorners& corners) {
  const Camera& camera = *workcell.camera;
  const Micrometres height = camera.location_um.z - workcell.work_surface_um;
  BoxCorners shape;
  for (std::size_t i = 0; i < kBoxCorners; ++i) {
    shape[i] = camera.projection == Projection::kPerspective
                   ? seen_from(camera.location_um, height, corners[i])
                   : SurfacePoint{corners[i].y, corners[i].x};
  }
  return shape;
}

BlockCorners corners_at(const PointUm& size, const Transform& pose) {
  const Eigen::Vector3d half(mm(size.x) / 2, mm(size.y) / 2, mm(size.z) / 2);
  BlockCorners corners;
  for (unsigned i = 0; i < kBoxCorners; ++i) {
    const Eigen::Vector4d corner((i & 1U) != 0 ? half.x() : -half.x(),
                                 (i & 2U) != 0 ? half.y() : -half.y(),
                                 (i & 4U) != 0 ? half.z() : -half.z(), 1.0);
    const Eigen::Vector4d p = pose * corner;
    corners[i] = {micrometres(p.x()), micrometres(p.y()), micrometres(p.z())};
  }
  return corners;
}

}  // namespace

BlockCorners corners_of(const Model& model, const State& state, std::size_t block) {
  return corners_at(state.blocks[block].size_um, block_pose(model, state, block));
}

int rows_of(const Workcell& workcell, const Block& block) {
  assert(workcell.camera);
  const BoxCorners shape = on_surface(workcell, corners_at(block.size_um, lying_pose(block)));
  const auto [low, high] = std::minmax_element(shape.begin(), shape.end());
  return rows_between(*workcell.camera, low->y, high->y);
}

void draw(const Workcell& workcell, const BlockCorners& corners, CameraFill& fill) {
  assert(workcell.camera);
  if (is_seen(*workcell.camera, corners)) fill.add(on_surface(workcell, corners));
}

}  // namespace xr3
