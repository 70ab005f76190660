// The `display` message's members: the paper's graphics display (wire frame, view, status line) as JSON. A
// pure function of model and state.
#pragma once

#include "core/model.hpp"
#include "core/state.hpp"
#include "protocol/json_source.hpp"

namespace xr3 {

/// Every member of a `display` message but op, cell, epoch, seq and tick. Points and `extents_mm` (left,
/// bottom, right, top) lie in the view, in mm to 3 decimals; colours are for a dark background. The wire
/// frame is there whether the display is on or off.
Json display_json(const Model& model, const State& state);

}  // namespace xr3
