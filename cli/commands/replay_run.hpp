// A recording that is repeated on a fresh cell, by `xr3 replay` and `xr3 convert`.
#pragma once

#include <string>

#include "cell/recording/replayer.hpp"
#include "cli/options/replay.hpp"
#include "protocol/recording/header.hpp"
#include "server/recording/joint_table.hpp"
#include "server/recording/source.hpp"

namespace xr3 {

class ReplayRun {
 public:
  /// `options` must outlive it. Each function throws FileError or DataError.
  explicit ReplayRun(const ReplayOptions& options)
      : options_(options), source_(options.file), header_(source_.header()) {}

  const recording::Header& header() const { return header_; }

  /// Repeats the recording up to its end or `--until`, writes the table of `--csv`, and prints
  /// how far it came. Returns whether all inputs had the recorded results; if not, prints the first
  /// difference.
  bool repeat(Cell& cell);

 private:
  bool apply_all(Replayer& replayer);
  void add_row(JointTable& table, const Cell& cell) const;
  void require_stop(const Cell& cell) const;
  void report(const Cell& cell, const Replayer& replayer) const;
  void note(const std::string& text) const;

  const ReplayOptions& options_;
  RecordingSource source_;
  recording::Header header_;
};

}  // namespace xr3
