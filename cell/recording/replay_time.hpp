// A moment in the life of a cell.
#pragma once

#include <compare>

#include "core/units.hpp"
#include "protocol/explain/cell_event.hpp"

namespace xr3 {

/// Ordered by epoch, then tick.
struct ReplayTime {
  Epoch epoch = 0;
  Tick tick = 0;
  auto operator<=>(const ReplayTime&) const = default;
};

}  // namespace xr3
