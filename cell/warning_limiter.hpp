// Rate limiter for warnings, so that invalid bytes on one line do not flood log and event channel.
// It merges consecutive problems of a line with the same code into one note with a count, limits
// the notes per line and simulated second, and then reports the number suppressed.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "protocol/explain/cell_event.hpp"

namespace xr3 {

class WarningLimiter {
 public:
  static constexpr int kMaxNotesPerSecond = 64;

  /// If the current run has this code, counts the problem into it and returns true: no note is due.
  bool extends_run(LineId line, Tick tick, std::string_view code);

  /// Adds a problem of a line; returns the notes that are due now, in order.
  std::vector<CellNote> add(LineId line, Tick tick, ProblemNote note);

  /// Whether a line may have notes that are due.
  bool has_lines() const { return !lines_.empty(); }

  /// Ends the current run of a line, at the end of a read or before another event; returns the
  /// notes that are due.
  std::vector<CellNote> finish(LineId line, Tick tick);

  /// Whether suppressed warnings have not been reported yet.
  bool has_pending() const { return pending_lines_ > 0; }
  /// The reports that are due for completed seconds, by line.
  std::vector<std::pair<LineId, CellNote>> take_pending(Tick tick);

  /// Removes a line that closes, or whose epoch ends; returns its pending notes.
  std::vector<CellNote> forget(LineId line);

  bool operator==(const WarningLimiter&) const = default;

 private:
  struct PerLine {
    std::optional<ProblemNote> run;
    Tick second = -1;
    int notes = 0;
    int left_out = 0;
    bool operator==(const PerLine&) const = default;
  };

  std::vector<CellNote> begin_second(PerLine& line, Tick tick);
  void end_run(PerLine& line, std::vector<CellNote>& due);
  void flush(PerLine& line, std::vector<CellNote>& due);

  std::map<LineId, PerLine> lines_;
  std::size_t pending_lines_ = 0;  ///< number of lines with unreported suppressed warnings
};

}  // namespace xr3
