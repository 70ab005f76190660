// The counters of a cell as Prometheus reads them. It knows no cell and no connection.
#pragma once

#include <string>

#include "server/counters.hpp"

namespace xr3 {

inline constexpr const char* kMetricsType = "text/plain; version=0.0.4; charset=utf-8";

/// Each metric with HELP and TYPE, its samples labelled with the cell; every kind of command and every
/// channel has its sample from the start, a code of a warning once it has been seen.
std::string metrics_text(const std::string& cell, const CellCounters& counters);

}  // namespace xr3
