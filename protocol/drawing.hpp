// The robot in its workcell as a picture: what `xr3 draw` writes and the monitor port shows.
#pragma once

#include "core/model.hpp"
#include "core/state.hpp"
#include "protocol/picture.hpp"

namespace xr3 {

inline constexpr int kUsualPictureWidthPx = 900;

/// The wire frame as it is now, with the work surface, seen along the vector; with room for all that
/// sticks out of the paper's view plane. width_px: kLeastPictureWidthPx...kMostPictureWidthPx.
Picture drawing(const Model& model, const State& state, const ViewVector& view, int width_px);

}  // namespace xr3
