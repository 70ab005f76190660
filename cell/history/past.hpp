// Makes a moment of a cell's past again.
#pragma once

#include <memory>
#include <optional>

#include "cell/history/history.hpp"
#include "cell/recording/difference.hpp"
#include "protocol/recording/header.hpp"

namespace xr3 {

/// A cell as it was. It can be read, and go on by itself.
struct Past {
  std::unique_ptr<Cell> cell;
  std::optional<Difference> difference;  ///< set if the history does not fit itself: a defect
};

/// The cell as it was when a part began. `header` is that of a recording of the cell.
std::unique_ptr<Cell> cell_at_start(const recording::Header& header, const HistoryPart& part);

/// The cell at `time`, or as little later as whole inputs of the byte clock allow. `header` is that
/// of a recording of the cell. Bounded work; for any thread. Precondition: `part` is what
/// History::part_before() gave for the time.
Past make_past(const recording::Header& header, const HistoryPart& part, const ReplayTime& time);

}  // namespace xr3
