#include "core/camera.hpp"

#include <algorithm>
#include <array>

#include "core/camera_fill.hpp"
#include "core/grasp.hpp"

namespace xr3 {
namespace {

using Corners = std::array<PointUm, kBoxCorners>;

Corners corners_of(const Block& block, const Transform& pose) {
  const Eigen::Vector3d half(mm(block.size_um.x) / 2, mm(block.size_um.y) / 2,
                             mm(block.size_um.z) / 2);
  Corners corners;
  for (unsigned i = 0; i < kBoxCorners; ++i) {
    const Eigen::Vector4d corner((i & 1U) != 0 ? half.x() : -half.x(),
                                 (i & 2U) != 0 ? half.y() : -half.y(),
                                 (i & 4U) != 0 ? half.z() : -half.z(), 1.0);
    const Eigen::Vector4d p = pose * corner;
    corners[i] = {micrometres(p.x()), micrometres(p.y()), micrometres(p.z())};
  }
  return corners;
}

/// The nearest whole number, halves away from zero. divisor > 0.
Micrometres rounded(Micrometres number, Micrometres divisor) {
  const Micrometres half = divisor / 2;
  return (number < 0 ? number - half : number + half) / divisor;
}

/// Along the line of sight from the camera through the corner, onto the work surface.
SurfacePoint seen_from(const PointUm& eye, Micrometres height_um, const PointUm& corner) {
  const Micrometres depth = std::max(eye.z - corner.z, kNearestSightUm);
  return {eye.y + rounded((corner.y - eye.y) * height_um, depth),
          eye.x + rounded((corner.x - eye.x) * height_um, depth)};
}

class Sight {
 public:
  Sight(const Model& model, const State& state)
      : model_(model), state_(state), camera_(*model.workcell().camera) {}

  Image whole() const { return rows(0, camera_.pixels_y); }

  Image rows(int first_row, int count) const {
    CameraFill fill(camera_, first_row, count);
    for (std::size_t i = 0; i < state_.blocks.size(); ++i) {
      const Corners corners = corners_of(state_.blocks[i], block_pose(model_, state_, i));
      if (is_seen(corners)) fill.add(on_surface(corners));
    }
    return fill.image();
  }

 private:
  bool is_seen(const Corners& corners) const {
    return camera_.projection == Projection::kOrthographic ||
           std::any_of(corners.begin(), corners.end(), [this](const PointUm& corner) {
             return camera_.location_um.z - corner.z > kNearestSightUm;
           });
  }

  BoxCorners on_surface(const Corners& corners) const {
    const Micrometres height = camera_.location_um.z - model_.workcell().work_surface_um;
    BoxCorners shape;
    for (std::size_t i = 0; i < kBoxCorners; ++i) {
      shape[i] = camera_.projection == Projection::kPerspective
                     ? seen_from(camera_.location_um, height, corners[i])
                     : SurfacePoint{corners[i].y, corners[i].x};
    }
    return shape;
  }

  const Model& model_;
  const State& state_;
  const Camera& camera_;
};

}  // namespace

Image camera_image(const Model& model, const State& state) { return Sight(model, state).whole(); }

Image camera_row(const Model& model, const State& state, int row) {
  return Sight(model, state).rows(row, 1);
}

bool camera_pixel(const Model& model, const State& state, int column, int row) {
  return camera_row(model, state, row).at(column, 0);
}

}  // namespace xr3
