#include "cell/recording/checkpoint.hpp"

#include <cassert>

namespace xr3 {

Cell::Checkpoint Cell::checkpoint() const {
  assert(!device_);
  return {model_ptr(), state(), epoch_,     model_rev_, clock_.mode(), clock_.rate(),
          agenda_,     lines_,  last_line_, snapshots_, acts_};
}

// The revision goes on, so that nobody takes the old state for the new one.
void Cell::restore(const Checkpoint& from) {
  assert(!device_);
  simulation_.restore(from.model, from.state);
  epoch_ = from.epoch;
  model_rev_ = from.model_rev;
  clock_ = SimClock::real(from.rate, 0, from.state.tick);
  if (from.mode == ClockMode::kManual) clock_.pause(0);
  agenda_ = from.agenda;
  lines_ = from.lines;
  last_line_ = from.last_line;
  snapshots_ = from.snapshots;
  acts_ = from.acts;
  woken_.clear();
  warnings_ = {};
  is_replayed_ = true;
  ++revision_;
}

}  // namespace xr3
