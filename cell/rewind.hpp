// The refusal of calls while a cell is in its past.
#pragma once

#include "protocol/monitor/call.hpp"

namespace xr3 {

/// The refusal of whatever would change a cell that is in its past.
call::Refused in_the_past();

}  // namespace xr3
