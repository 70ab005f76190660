// The camera's view of one block: its corners in the base frame, and their projection onto the work
// surface. camera.hpp renders whole images, cache.hpp caches them.
#pragma once

#include <array>

#include "core/camera/fill.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The corners of a block in the base frame, in whole micrometres.
using BlockCorners = std::array<PointUm, kBoxCorners>;

/// The corners of a block at its current pose, also if it is held.
BlockCorners corners_of(const Model& model, const State& state, std::size_t block);

/// The number of rows of the image that a block at rest occupies. Precondition: the workcell has a
/// camera.
int rows_of(const Workcell& workcell, const Block& block);

/// Draws a block as the workcell's camera sees it. Precondition: the workcell has a camera.
void draw(const Workcell& workcell, const BlockCorners& corners, CameraFill& fill);

}  // namespace xr3
