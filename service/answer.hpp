// What the answers to many calls have in common.
#pragma once

#include "cell/cell.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/request_error.hpp"

namespace xr3::service {

/// Epoch and tick, the first members of the value of each call.
Json value_now(const Cell& cell);

/// The answer with an error.
monitor::Message refused(const monitor::RequestId& id, const call::Refused& why);

/// The error of a request that names a line that is not open.
call::Refused no_such_line(LineId line);

}  // namespace xr3::service
