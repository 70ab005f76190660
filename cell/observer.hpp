// Sees what happens in a cell: its inputs, and what comes of them. Recorder, history, judge and log
// are observers. An observer must not change the cell, and hears what it overrides.
#pragma once

#include "cell/input.hpp"
#include "cell/output.hpp"

namespace xr3 {

class Cell;

class CellObserver {
 public:
  CellObserver() = default;
  CellObserver(const CellObserver&) = delete;
  CellObserver& operator=(const CellObserver&) = delete;
  virtual ~CellObserver() = default;

  /// Time has advanced to an input, which acts next.
  virtual void before(const Cell& /*cell*/, const Input& /*input*/) {}
  /// This has come of the input that acts, or of the passing of time.
  virtual void happened(const Cell& /*cell*/, const CellOutput& /*output*/) {}
  /// The input has acted.
  virtual void after(const Cell& /*cell*/, const Input& /*input*/, const Applied& /*applied*/) {}
  /// A tick has passed. Ticks at rest may be left out, except for the last one of an advance. Only
  /// for an observer that asked for ticks.
  virtual void ticked(const Cell& /*cell*/) {}
};

}  // namespace xr3
