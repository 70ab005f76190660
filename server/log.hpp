// The log on standard error. It never makes the server wait: what a full pipe cannot take is dropped.
#pragma once

#include <string>

#include "core/model.hpp"
#include "protocol/cell_event.hpp"

namespace xr3 {

/// Makes spdlog's default logger write to standard error from `level` up (trace, debug, ... off).
void start_log(const std::string& level);

/// Writes an event of a cell: problems and lines at info, the machine's motion at debug.
void log_event(const CellEvent& event, const Model& model);

}  // namespace xr3
