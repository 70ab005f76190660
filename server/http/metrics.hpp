// The counters of a cell in the Prometheus text format.
#pragma once

#include <string>

#include "cell/counters.hpp"

namespace xr3 {

inline constexpr const char* kMetricsType = "text/plain; version=0.0.4; charset=utf-8";

/// Each metric with HELP and TYPE; all samples have the label `cell`. Every kind of command and
/// every channel has a sample from the start, a code of a warning after its first occurrence.
std::string metrics_text(const std::string& cell, const CellCounters& counters);

}  // namespace xr3
