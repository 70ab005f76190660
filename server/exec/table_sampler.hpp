// Samples a cell for the table of `xr3 exec --csv`: a line for each so many milliseconds of simulated
// time.
#pragma once

#include <string>

#include "cell/cell.hpp"
#include "server/recording/joint_table.hpp"

namespace xr3 {

class TableSampler final : private CellWatcher {
 public:
  /// Begins with a line for now. The cell must outlive the sampler.
  explicit TableSampler(Cell& cell);
  ~TableSampler() override { cell_.end_watch(*this); }

  const std::string& text() const { return table_.text(); }
  /// The time between two lines.
  static constexpr Tick kEvery = 100;

 private:
  void event(const Cell&, const CellEvent&) override {}
  void after_tick(const Cell& cell) override;

  Cell& cell_;
  JointTable table_;
  Epoch epoch_ = 0;
  Tick next_ = 0;
};

}  // namespace xr3
