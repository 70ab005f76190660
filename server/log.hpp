// The log on standard error. It never blocks: messages are dropped while a pipe is full.
#pragma once

#include <string>

#include "core/model.hpp"
#include "protocol/explain/cell_event.hpp"

namespace xr3 {

/// Makes spdlog's default logger write to standard error from `level` up (trace, debug, ... off).
void start_log(const std::string& level);

/// Logs an event of a cell: the machine's events at debug, except stalls and warnings; all others
/// at info.
void log_event(const CellEvent& event, const Model& model);

}  // namespace xr3
