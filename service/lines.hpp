// What the call `send` does on a line of the client's own.
#pragma once

#include <optional>
#include <string_view>

#include "service/calls.hpp"

namespace xr3::service {

/// Why a client whose line is `own` cannot send now; nullopt if it can. Without a line it gets one
/// by open_line().
std::optional<call::Refused> refuse_send(const Cell& cell, std::optional<LineId> own);

/// Opens a line of the monitor.
LineId open_line(Cell& cell, WallNs now);

/// The answer to a `send` of which the line has taken `taken` bytes: with the replies so far, which
/// leave the outbox.
monitor::Message sent(const CellCall& of, const monitor::Send& send, LineId line,
                      std::size_t taken);

}  // namespace xr3::service
