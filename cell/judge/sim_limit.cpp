#include "cell/judge/sim_limit.hpp"

#include <algorithm>

#include "cell/transcript.hpp"

namespace xr3 {

JudgedMoment moment_of(const Cell& cell, const RunObserver& observer) {
  JudgedMoment moment{cell.state(), observer.facts(), ""};
  if (const Transcript* transcript = cell.transcript())
    moment.transcript = transcript_digest(transcript->summary(), cell.model(), cell.state(),
                                          cell.clock_remainder());
  return moment;
}

SimLimit::SimLimit(Cell& cell, const RunObserver& observer, Tick limit)
    : cell_(cell), observer_(observer), limit_(limit) {
  cell.observe(*this, Cell::Ticks::kEach);
}

Tick SimLimit::left(Tick most) const {
  if (limit_ == 0) return most;
  return std::clamp<Tick>(limit_ - cell_.state().tick, 0, most);
}

// Checks the limit after a tick. Ticks at rest are left out: nothing changes in them but the tick.
void SimLimit::ticked(const Cell& cell) {
  if (limit_ == 0 || moment_ || cell.state().tick < limit_) return;
  moment_ = moment_of(cell, observer_);
  moment_->state.tick = limit_;
}

}  // namespace xr3
