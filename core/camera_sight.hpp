// How the camera sees one block: its corners in the base frame, and these onto the work surface. It
// decides what is drawn, not when; whole pictures are camera.hpp's, kept ones camera_cache.hpp's.
#pragma once

#include <array>

#include "core/camera_fill.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The corners of a block in the base frame, in whole micrometres.
using BlockCorners = std::array<PointUm, kBoxCorners>;

/// As the block lies, or hangs in the jaws, now.
BlockCorners corners_of(const Model& model, const State& state, std::size_t block);

/// Draws a block as the workcell's camera sees it. The workcell has a camera.
void draw(const Workcell& workcell, const BlockCorners& corners, CameraFill& fill);

}  // namespace xr3
