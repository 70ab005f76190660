// Sees what happens in a cell: every event, and every tick in which a motor may have made a count.
// For a judge, who must miss nothing between two inputs.
#pragma once

#include "protocol/explain/cell_event.hpp"

namespace xr3 {

class Cell;

class CellWatcher {
 public:
  CellWatcher() = default;
  CellWatcher(const CellWatcher&) = delete;
  CellWatcher& operator=(const CellWatcher&) = delete;
  virtual ~CellWatcher() = default;

  virtual void event(const Cell& cell, const CellEvent& event) = 0;
  /// A tick has passed. Ticks at rest may be left out, except for the last one of an advance.
  virtual void after_tick(const Cell& cell) = 0;
};

}  // namespace xr3
