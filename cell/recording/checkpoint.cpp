#include "cell/recording/checkpoint.hpp"

#include <cassert>

namespace xr3 {

Cell::Checkpoint Cell::checkpoint() const {
  assert(!device_);
  return {model_ptr(), state(), epoch_,     model_rev_, clock_,     byte_clock_, transcript_,
          agenda_,     lines_,  last_line_, snapshots_, due_bytes_, is_in_past_, was_manual_};
}

// The revision goes on, so that nobody takes the old state for the new one.
void Cell::restore(const Checkpoint& from) {
  assert(!device_);
  simulation_.restore(from.model, from.state);
  epoch_ = from.epoch;
  model_rev_ = from.model_rev;
  clock_ = from.clock;
  clock_.set_tick(from.state.tick, 0);
  byte_clock_ = from.byte_clock;
  transcript_ = from.transcript;
  agenda_ = from.agenda;
  lines_ = from.lines;
  if (transcript_) {
    for (auto& [id, line] : lines_) line.listen(*this, id);
  }
  last_line_ = from.last_line;
  snapshots_ = from.snapshots;
  due_bytes_ = from.due_bytes;
  is_in_past_ = from.is_in_past;
  was_manual_ = from.was_manual;
  woken_.clear();
  warnings_ = {};
  contests_ = {};
  is_replayed_ = true;
  ++revision_;
}

}  // namespace xr3
