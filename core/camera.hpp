// The overhead camera (paper, Sections II-B and III-B): a binary image of the blocks, held ones
// included; the robot is not seen. Whole micrometres and exact fractions decide every pixel, so an
// image is the same bits on every machine.
#pragma once

#include "core/image.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// A perspective camera sees a block only up to this far below its own height; what is higher is cut
/// off, and a block that is higher altogether (only a held one can be) is not seen.
inline constexpr Micrometres kNearestSightUm = 1000;

/// The whole picture. A pixel is 1 when its centre lies in the image of a block: edges at low x and
/// low y belong to it, those at high x and high y do not. The workcell has a camera.
Image camera_image(const Model& model, const State& state);

/// One row of it, 0...pixels_y - 1 from the top, as a picture one pixel high.
Image camera_row(const Model& model, const State& state, int row);

/// One pixel of it: column 0...pixels_x - 1 from the left, row 0...pixels_y - 1 from the top.
bool camera_pixel(const Model& model, const State& state, int column, int row);

}  // namespace xr3
