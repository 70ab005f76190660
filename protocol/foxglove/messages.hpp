// The messages of the machine, its camera and its events, as JSON on one line. Pure functions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/model.hpp"
#include "core/state.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/foxglove/time.hpp"
#include "protocol/scene/links.hpp"

namespace xr3::foxglove {

/// foxglove.FrameTransforms: the frames of the links in those of their parents. `links` are those
/// of the model.
std::string transforms_text(const std::vector<SceneLink>& links, const Model& model,
                            const State& state, Nanoseconds time);

/// foxglove.CompressedImage: a picture of the camera. `png` is the file in base64.
std::string image_text(std::string_view png, Nanoseconds time);

/// foxglove.Log: an event with its sentence. Its name is the kind and the code, such as
/// `warning/jaws_touch`.
std::string log_text(const CellEvent& event, const Model& model, Nanoseconds time);

/// xr3.State, for plots: numbers in mm and degrees as in the monitor's `state`, and empty texts
/// instead of null.
std::string state_text(const Model& model, const State& state, Epoch epoch);

}  // namespace xr3::foxglove
