#include "core/camera/cache.hpp"

#include <algorithm>
#include <utility>

#include "core/camera.hpp"
#include "core/faults/camera_faults.hpp"

namespace xr3 {
namespace {

// Number of rows drawn separately before the whole image is drawn. A row projects the corners of
// each block, as the whole image does, so after this many rows the whole image is cheaper.
constexpr int kMaxParts = 2;

}  // namespace

ImagePtr CameraCache::image(const Model& model, const State& state) {
  compare(model, state);
  ImagePtr clean = clean_image(model, state);
  if (!state.faults.now.on_camera) return clean;
  if (!faulty_ || faulty_tick_ != state.tick)
    faulty_ = std::make_shared<const Image>(with_camera_faults(state, *clean));
  faulty_tick_ = state.tick;
  return faulty_;
}

ImagePtr CameraCache::clean_image(const Model& model, const State& state) {
  if (whole_) return whole_;
  if (!resting_) draw_resting(model, state);
  whole_ = resting_;
  if (!held_corners_) return whole_;
  CameraFill fill(*model.workcell().camera, *resting_);
  draw(model.workcell(), *held_corners_, fill);
  ++renders_;
  whole_ = std::make_shared<const Image>(fill.take_image());
  return whole_;
}

Image CameraCache::row(const Model& model, const State& state, int row) {
  compare(model, state);
  if (state.faults.now.on_camera)
    return row_with_camera_faults(state, *clean_image(model, state), row);
  if (!needs_only_a_part()) return image(model, state)->row_image(row);
  return camera_row(model, state, row);
}

bool CameraCache::pixel(const Model& model, const State& state, int column, int row) {
  if (state.faults.now.on_camera) return this->row(model, state, row).at(column, 0);
  compare(model, state);
  if (!needs_only_a_part()) return image(model, state)->at(column, row);
  return camera_pixel(model, state, column, row);
}

bool CameraCache::needs_only_a_part() {
  if (resting_ || parts_ >= kMaxParts) return false;
  ++parts_;
  ++renders_;
  return true;
}

// --- Validation.

void CameraCache::compare(const Model& model, const State& state) {
  if (std::exchange(is_compared_, true)) return;
  faulty_.reset();
  if (!is_same_scene(model, state)) {
    keep_scene(model, state);
    resting_.reset();
    whole_.reset();
    parts_ = 0;
  }
  std::optional<BlockCorners> held_corners;
  if (state.held) held_corners = corners_of(model, state, state.held->block);
  if (held_corners != held_corners_) whole_.reset();
  held_corners_ = held_corners;
}

bool CameraCache::is_at(const Block& block, const BlockPose& place) {
  return block.centroid_um == place.centroid_um && block.yaw_udeg == place.yaw_udeg &&
         block.size_um == place.size_um;
}

bool CameraCache::is_same_scene(const Model& model, const State& state) const {
  const Workcell& workcell = model.workcell();
  const auto held = state.held ? std::optional(state.held->block) : std::nullopt;
  return scene_ && scene_->held == held && scene_->camera == *workcell.camera &&
         scene_->work_surface_um == workcell.work_surface_um &&
         std::equal(state.blocks.begin(), state.blocks.end(), scene_->places.begin(),
                    scene_->places.end(), is_at);
}

void CameraCache::keep_scene(const Model& model, const State& state) {
  Scene scene{*model.workcell().camera, model.workcell().work_surface_um, {}, std::nullopt};
  if (state.held) scene.held = state.held->block;
  scene.places.reserve(state.blocks.size());
  for (const Block& block : state.blocks)
    scene.places.push_back({block.size_um, block.centroid_um, block.yaw_udeg});
  scene_ = std::move(scene);
}

void CameraCache::draw_resting(const Model& model, const State& state) {
  const Workcell& workcell = model.workcell();
  CameraFill fill(*workcell.camera, 0, workcell.camera->pixels_y);
  for (std::size_t i = 0; i < state.blocks.size(); ++i) {
    if (scene_->held != i) draw(workcell, corners_of(model, state, i), fill);
  }
  ++renders_;
  resting_ = std::make_shared<const Image>(fill.take_image());
}

}  // namespace xr3
