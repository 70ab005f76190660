// The members of a `line` message as JSON: bytes of a serial line with their explanation.
#pragma once

#include "core/model.hpp"
#include "protocol/explain/wire_record.hpp"
#include "protocol/json/source.hpp"

namespace xr3 {

/// All members of a `line` message except op, cell, epoch, seq and tick. `hex` and `text` have the
/// bytes that the record keeps; `bytes` is the number of all bytes.
Json wire_json(const WireRecord& record, const Model& model);

}  // namespace xr3
