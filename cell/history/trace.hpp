// States of a cell's past, one every so many ticks: what was drawn as a plot, had one watched.
#pragma once

#include <optional>
#include <vector>

#include "cell/history/history.hpp"
#include "cell/recording/difference.hpp"
#include "protocol/monitor/snapshot.hpp"
#include "protocol/recording/header.hpp"

namespace xr3 {

/// Ticks of one epoch, both included.
struct TraceSpan {
  Epoch epoch = 0;
  Tick from = 0;
  Tick to = 0;
  Tick every = 1;  ///< > 0
};

struct PastTrace {
  std::vector<Snapshot> states;          ///< in order; of equal ones the first and the last
  std::optional<Difference> difference;  ///< set if the history does not fit itself: a defect
};

/// The states of a part of a history at the multiples of `every` ticks, and at the end. With the
/// byte clock, time passes in whole inputs, and so do the states. `header` is that of a recording
/// of the cell. For any thread. Preconditions: `part` is what History::part_before() gave for
/// the first tick, and `to` is not after History::end_of_part().
PastTrace trace_past(const recording::Header& header, const HistoryPart& part,
                     const TraceSpan& span);

}  // namespace xr3
