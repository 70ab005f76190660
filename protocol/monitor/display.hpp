// The members of a `display` message: the paper's graphics display (wire frame, view, status line)
// as JSON. A pure function of model and state.
#pragma once

#include "core/model.hpp"
#include "core/state.hpp"
#include "protocol/json/source.hpp"

namespace xr3 {

/// All members of a `display` message except op, cell, epoch, seq and tick. Points and `extents_mm`
/// (left, bottom, right, top) are projected onto the view, in mm with 3 decimals; colours are for a
/// dark background. The wire frame is included even if the display is off.
Json display_json(const Model& model, const State& state);

}  // namespace xr3
