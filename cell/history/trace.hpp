// States of a cell's past at regular times, for plots.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "cell/history/history.hpp"
#include "cell/recording/difference.hpp"
#include "protocol/json/values.hpp"
#include "protocol/recording/header.hpp"

namespace xr3 {

/// Ticks of one epoch, both included.
struct TraceSpan {
  Epoch epoch = 0;
  Tick from = 0;
  Tick to = 0;
  Tick every = 1;  ///< > 0
};

struct PastTrace {              // NOLINT(bugprone-exception-escape): to move a Json does not throw
  Json states = Json::array();  ///< {"tick","joints","tool"} each; of equal ones first and last
  Tick to = 0;                  ///< the last tick that was looked at
  std::optional<Difference> difference;  ///< set if the history does not fit itself: a defect
};

/// Joints and tool, as in a `state` message, in a part of a history: at the multiples of `every`
/// ticks, and at the end. With the byte clock, time passes in whole inputs, so they are those after
/// an input. `header` is that of a recording of the cell. For any thread. Preconditions: `part` is
/// what History::part_before() gave for the first tick, and `to` is not after
/// History::end_of_part().
PastTrace trace_past(const recording::Header& header, const HistoryPart& part,
                     const TraceSpan& span);

}  // namespace xr3
