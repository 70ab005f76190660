// The members of the messages of channels without loss as JSON: an event of a cell, and bytes of a
// serial line with their explanation. Pure functions of the value and the model.
#pragma once

#include "core/model.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/explain/wire_record.hpp"
#include "protocol/json/source.hpp"

namespace xr3 {

/// All members of an `event` message except op, cell, epoch, seq and tick. Lengths in mm, yaw in
/// degrees.
Json event_json(const CellEvent& event, const Model& model);

/// All members of a `line` message except op, cell, epoch, seq and tick. `hex` and `text` have the
/// bytes that the record keeps; `bytes` is the number of all bytes.
Json wire_json(const WireRecord& record, const Model& model);

}  // namespace xr3
