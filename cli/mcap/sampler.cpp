#include "cli/mcap/sampler.hpp"

#include <cassert>
#include <utility>

#include "core/step.hpp"

namespace xr3 {
namespace {

bool is_earlier(const CellEvent& event, const WireRecord& record) {
  return std::pair(event.epoch, event.tick) < std::pair(record.epoch, record.tick);
}

}  // namespace

CellSampler::CellSampler(Cell& cell, Tick every, FoxgloveMessages& messages)
    : cell_(cell), every_(every), messages_(messages) {
  assert(every > 0);
  sample();
  cell.observe(*this, Cell::Ticks::kEach);
}

void CellSampler::before(const Cell& cell, const Input& /*input*/) { messages_.pass_to(cell); }

void CellSampler::happened(const Cell& cell, const CellOutput& output) {
  auto record = output.records().begin();
  for (const CellEvent& event : output.events) {
    while (record != output.records().end() && !is_earlier(event, *record))
      messages_.add_wire(*record++, cell.model());
    messages_.add_event(event, cell.model());
  }
  while (record != output.records().end()) messages_.add_wire(*record++, cell.model());
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
