// The bytes of serial lines with their meaning, as messages of a log.
#pragma once

#include <string>

#include "core/model.hpp"
#include "protocol/explain/wire_record.hpp"
#include "protocol/foxglove/time.hpp"

namespace xr3::foxglove {

/// foxglove.Log: bytes in one direction with their meaning, such as `> E?\r  asks how far E has
/// still to go`. `>` is to the robot. The name is that of the line, such as `line 1`.
std::string log_text(const WireRecord& record, const Model& model, Nanoseconds time);

}  // namespace xr3::foxglove
