#include "server/exec/table_sampler.hpp"

namespace xr3 {

TableSampler::TableSampler(Cell& cell) : cell_(cell), table_(cell.model()), epoch_(cell.epoch()) {
  after_tick(cell);
  cell.watch(*this);
}

// A cell passes over ticks at rest, in which nothing changes.
void TableSampler::after_tick(const Cell& cell) {
  if (cell.epoch() != epoch_) {
    epoch_ = cell.epoch();
    next_ = 0;
  }
  for (; next_ <= cell.state().tick; next_ += kEvery) table_.add(cell, next_);
}

}  // namespace xr3
