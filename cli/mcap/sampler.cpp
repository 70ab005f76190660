#include "cli/mcap/sampler.hpp"

#include <cassert>

#include "core/step.hpp"

namespace xr3 {
CellSampler::CellSampler(Cell& cell, Tick every, FoxgloveMessages& messages)
    : cell_(cell), every_(every), messages_(messages) {
  assert(every > 0);
  sample();
  cell.observe(*this, Cell::Ticks::kEach);
}

void CellSampler::before(const Cell& cell, const Input& /*input*/) { messages_.pass_to(cell); }

void CellSampler::happened(const Cell& cell, const CellOutput& output) {
  for (const WireRecord& each : output.records()) messages_.add_wire(each, cell.model());
  for (const CellEvent& each : output.events) messages_.add_event(each, cell.model());
}

void CellSampler::after(const Cell& /*cell*/, const Input& /*input*/, const Applied& /*applied*/) {
  if (is_due()) sample();
}

void CellSampler::ticked(const Cell& /*cell*/) {
  if (is_due()) sample();
}

bool CellSampler::is_due() const {
  if (cell_.epoch() != epoch_) return true;
  const bool is_moving = !is_at_rest(cell_.model(), cell_.state());
  if (is_moving != is_moving_) return true;
  if (is_moving) return cell_.state().tick / every_ != state_.tick / every_;
  return !is_same_state();
}

/// Whether nothing but the time has changed since the last sample.
bool CellSampler::is_same_state() const {
  State now = cell_.state();
  now.tick = state_.tick;
  return now == state_;
}

void CellSampler::sample() {
  epoch_ = cell_.epoch();
  state_ = cell_.state();
  is_moving_ = !is_at_rest(cell_.model(), state_);
  messages_.add_state(cell_);
}

}  // namespace xr3
