// The table of `xr3 replay --csv`: joint variables, motor counts and the tip over time.
#pragma once

#include <string>

#include "cell/cell.hpp"

namespace xr3 {

class ReplayTable {
 public:
  explicit ReplayTable(const Model& model);

  /// Adds a line for the cell's current tick. Precondition: it has the robot of the model.
  void add(const Cell& cell);
  /// The header and all lines, each with a line feed.
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace xr3
