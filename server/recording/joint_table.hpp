// The table of `xr3 replay --csv` and `xr3 exec --csv`: joint variables, motor counts and the tip
// over time.
#pragma once

#include <string>

#include "cell/cell.hpp"

namespace xr3 {

class JointTable {
 public:
  explicit JointTable(const Model& model);

  /// Adds a line for a tick at which the cell was as it is now. Precondition: it has the robot of
  /// the model.
  void add(const Cell& cell, Tick tick);
  /// The header and all lines, each with a line feed.
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace xr3
