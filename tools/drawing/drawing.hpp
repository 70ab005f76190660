// The robot in its workcell as a picture, for `xr3 draw` and the monitor port.
#pragma once

#include "core/model.hpp"
#include "core/state.hpp"
#include "tools/drawing/picture.hpp"

namespace xr3 {

inline constexpr int kUsualPictureWidthPx = 900;

/// The current wire frame with the work surface, seen along the vector. The picture is large enough
/// for the parts outside the paper's view plane. width_px:
/// kMinPictureWidthPx...kMaxPictureWidthPx.
Picture drawing(const Model& model, const State& state, const ViewVector& view, int width_px);

}  // namespace xr3
