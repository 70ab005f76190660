// A cell in memory that is recorded, and replays of its recording.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/recording/recorder.hpp"
#include "cell/recording/replayer.hpp"
#include "protocol/recording/writer.hpp"

namespace xr3::test {

/// What a cell is made of beside its model.
struct CellSetup {
  SimClock clock = SimClock::real({}, 0);
  std::optional<LineSpeed> line_speed = {};
  FaultPlan faults = {};
  bool has_device = false;
};

/// A cell whose inputs are recorded from the start.
class RecordedCell {
 public:
  explicit RecordedCell(ModelPtr model, const CellSetup& setup = {});
  ~RecordedCell() { cell.end_observation(recorder_); }

  /// The whole recording, to its end at the current tick.
  std::string text();
  const std::vector<recording::Entry>& entries() const { return entries_; }

  Cell cell;

 private:
  std::vector<recording::Entry> entries_;
  recording::RecordingWriter writer_;
  std::string text_;
  Recorder recorder_;
};

/// The result of a replay.
struct Replayed {
  std::optional<Difference> difference;
  State state;
  std::string hash;
  std::uint64_t inputs = 0;
  std::string program;
};

/// Reads a recording from its text, in pieces, and replays it on a fresh cell. Throws DataError.
Replayed replay(const std::string& text, std::optional<ReplayTime> until = {});

}  // namespace xr3::test
