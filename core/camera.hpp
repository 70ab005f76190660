// The overhead camera (paper, Sections II-B and III-B): a binary image of the blocks, including a
// held one; the robot is not visible. Pixels are computed from whole micrometres with exact
// fractions, so an image has the same bits on every machine.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The minimum depth below a perspective camera. Corners above it are projected as if they were at
/// this depth; a block entirely above it (only a held one can be) is not visible.
inline constexpr Micrometres kNearestSightUm = 1000;

/// The maximum of camera_rows(). An image takes a few nanoseconds for each row of each block, and
/// other lines wait meanwhile.
inline constexpr std::int64_t kMaxCameraRows = 500'000;

/// The sum of the numbers of image rows that the blocks occupy if none is held; 0 without a camera.
std::int64_t camera_rows(const Workcell& workcell, const std::vector<Block>& blocks);

/// The whole image. A pixel is 1 if its centre lies in the projection of a block; edges at low x
/// and low y belong to the projection, those at high x and high y do not. Precondition: the
/// workcell has a camera.
Image camera_image(const Model& model, const State& state);

/// One row of camera_image(), 0...pixels_y - 1 from the top, as an image one pixel high.
/// Precondition: the workcell has a camera.
Image camera_row(const Model& model, const State& state, int row);

/// One pixel of camera_image(): column 0...pixels_x - 1 from the left, row 0...pixels_y - 1 from
/// the top. Precondition: the workcell has a camera.
bool camera_pixel(const Model& model, const State& state, int column, int row);

}  // namespace xr3
