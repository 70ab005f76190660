// The counters of a cell and of its process in the Prometheus text format.
#pragma once

#include <string>

#include "cell/counters.hpp"
#include "server/resources/process_stats.hpp"

namespace xr3 {

inline constexpr const char* kMetricsType = "text/plain; version=0.0.4; charset=utf-8";

/// Each metric with HELP and TYPE; all samples but those of the process have the label `cell`. With
/// an empty `cell`, the samples are sums of many cells and have no such label.
/// Every kind of command, reason and channel has a sample from the start, a code of a warning after
/// its first occurrence.
std::string metrics_text(const std::string& cell, const CellCounters& counters,
                         const ProcessStats& process);

}  // namespace xr3
