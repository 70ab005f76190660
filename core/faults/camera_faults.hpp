// The effects of faults on the camera's image: shifted by an offset of the lens, with noise, with
// dead rows, in this order. A pure function of the clean image, the faults and the tick.
#pragma once

#include "core/event.hpp"
#include "core/image.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The image with the faults of the camera. Only the first fault of noise in force is applied; each
/// pixel takes one hash.
Image with_camera_faults(const State& state, const Image& clean);

/// Row `row` of with_camera_faults(), as an image one pixel high.
Image row_with_camera_faults(const State& state, const Image& clean, int row);

/// Counts an effect of each fault of the camera in force. Call for each inquiry that the camera
/// answers.
void add_camera_effects(const Model& model, State& state, Events& events);

}  // namespace xr3
