// Keeps a line of garbage from drowning everybody else: a run of one code on one line becomes one
// note with a count, and a line gets at most so many notes in a simulated second, then one that says
// how many were left out.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "protocol/cell_event.hpp"

namespace xr3 {

class WarningGate {
 public:
  static constexpr int kMostNotesPerSecond = 64;

  /// Counts one more problem into the run that stands open, if it has this code: then nothing is due.
  bool extends_run(LineId line, Tick tick, std::string_view code);

  /// Takes one problem of a line at a tick; returns the notes that are due now, in order.
  std::vector<CellNote> take(LineId line, Tick tick, ProblemNote note);

  /// The run that still stands open on a line ends: at the end of a read, or before another event.
  std::vector<CellNote> finish(LineId line, Tick tick);

  /// Some notes were left out, and nobody was told yet.
  bool owes_words() const { return owed_ > 0; }
  /// What is owed for seconds that are over, by line.
  std::vector<std::pair<LineId, CellNote>> words_owed(Tick tick);

  /// The line is closed, or a new epoch begins: returns what is still owed.
  std::vector<CellNote> forget(LineId line);

 private:
  struct PerLine {
    std::optional<ProblemNote> run;
    Tick second = -1;
    int notes = 0;
    int left_out = 0;
  };

  std::vector<CellNote> begin_second(PerLine& line, Tick tick);
  void end_run(PerLine& line, std::vector<CellNote>& due);
  void pay(PerLine& line, std::vector<CellNote>& due);

  std::map<LineId, PerLine> lines_;
  std::size_t owed_ = 0;  ///< lines of which notes were left out
};

}  // namespace xr3
