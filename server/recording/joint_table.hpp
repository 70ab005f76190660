// The table of `xr3 replay --csv` and `xr3 exec --csv`: joint variables, motor counts and the tip
// over time, written as it grows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "cell/cell.hpp"
#include "server/files/atomic_write.hpp"

namespace xr3 {

class JointTable {
 public:
  /// The maximum number of lines after the header; some 500 MB.
  static constexpr std::int64_t kMaxRows = 5'000'000;

  /// Begins a draft of the file, with a header. Throws FileError.
  JointTable(const Model& model, const std::filesystem::path& path);

  bool is_full() const { return rows_ == kMaxRows; }
  /// Adds a line for a tick at which the cell was in its current state. Throws FileError.
  /// Precondition: the cell has the robot of the model, and the table is not full.
  void add(const Cell& cell, Tick tick);
  /// Renames the draft to the file; nothing is added afterwards. Throws FileError.
  void finish();

 private:
  Draft draft_;
  std::string waiting_;  ///< not written yet
  std::int64_t rows_ = 0;
  std::string last_;  ///< columns of `motors_` and of the tip
  Motors motors_;     ///< motors of the last line
};

}  // namespace xr3
