#include "core/camera.hpp"

#include <cassert>

#include "core/camera/sight.hpp"

namespace xr3 {
namespace {

Image rows(const Model& model, const State& state, int first_row, int count) {
  assert(model.workcell().camera);
  CameraFill fill(*model.workcell().camera, first_row, count);
  for (std::size_t i = 0; i < state.blocks.size(); ++i) {
    draw(model.workcell(), corners_of(model, state, i), fill);
  }
  return fill.take_image();
}

}  // namespace

std::int64_t camera_rows(const Workcell& workcell, const std::vector<Block>& blocks) {
  std::int64_t rows = 0;
  if (!workcell.camera) return rows;
  for (const Block& block : blocks) rows += rows_of(workcell, block);
  return rows;
}

Image camera_image(const Model& model, const State& state) {
  assert(model.workcell().camera);
  return rows(model, state, 0, model.workcell().camera->pixels_y);
}

Image camera_row(const Model& model, const State& state, int row) {
  assert(model.workcell().camera);
  return rows(model, state, row, 1);
}

bool camera_pixel(const Model& model, const State& state, int column, int row) {
  assert(model.workcell().camera);
  return camera_row(model, state, row).at(column, 0);
}

}  // namespace xr3
