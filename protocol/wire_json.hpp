// The `line` message's members: bytes of a serial line and what was made of them, as JSON.
#pragma once

#include "core/model.hpp"
#include "protocol/json_source.hpp"
#include "protocol/wire_record.hpp"

namespace xr3 {

/// Every member of a `line` message but op, cell, epoch, seq and tick. `hex` and `text` show the bytes
/// that the record keeps, `bytes` says how many there were.
Json wire_json(const WireRecord& record, const Model& model);

}  // namespace xr3
