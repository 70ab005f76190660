// The `event` message's members: what a cell tells, as JSON. A pure function of one CellEvent and the
// model that it was told of; it knows no clients and no sequence numbers.
#pragma once

#include "core/model.hpp"
#include "protocol/cell_event.hpp"
#include "protocol/json_source.hpp"

namespace xr3 {

/// Every member of an `event` message but op, cell, epoch, seq and tick. Lengths in mm, yaw in degrees.
Json event_json(const CellEvent& event, const Model& model);

}  // namespace xr3
