// The members of an `event` message: an event of a cell as JSON. A pure function of the CellEvent
// and the model.
#pragma once

#include "core/model.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/json/source.hpp"

namespace xr3 {

/// All members of an `event` message except op, cell, epoch, seq and tick. Lengths in mm, yaw in
/// degrees.
Json event_json(const CellEvent& event, const Model& model);

}  // namespace xr3
