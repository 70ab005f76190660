// Watches a cell that repeats a recording, and adds its states, events and lines to a file.
#pragma once

#include "cell/cell.hpp"
#include "cli/mcap/foxglove_messages.hpp"

namespace xr3 {

/// Takes samples while the robot moves: at multiples of a time, and at the tick in which a motion
/// begins or ends, so that straight lines between samples are right. At rest it takes one when
/// something has changed, so a robot at rest costs nothing.
class CellSampler final : private CellObserver {
 public:
  /// Cell and messages outlive the sampler.
  CellSampler(Cell& cell, Tick every, FoxgloveMessages& messages);
  ~CellSampler() override { cell_.end_observation(*this); }

  /// Takes the last sample.
  void finish() { sample(); }

 private:
  void before(const Cell& cell, const Input& input) override;
  void happened(const Cell& cell, const CellOutput& output) override;
  void after(const Cell& cell, const Input& input, const Applied& applied) override;
  void ticked(const Cell& cell) override;

  bool is_due() const;
  bool is_same_state() const;
  void sample();

  Cell& cell_;
  Tick every_;
  FoxgloveMessages& messages_;
  // The last sample.
  Epoch epoch_ = 0;
  State state_;
  bool is_moving_ = false;
};

}  // namespace xr3
