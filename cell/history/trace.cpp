#include "cell/history/trace.hpp"

#include <cassert>
#include <memory>
#include <utility>

#include "cell/history/past.hpp"
#include "cell/recording/replayer.hpp"

namespace xr3 {
namespace {

bool is_same_but_time(Snapshot a, const Snapshot& b) {
  a.state.tick = b.state.tick;
  return a == b;
}

/// Takes the states, and leaves out those between two equal ones.
class Sampler {
 public:
  Sampler(std::vector<Snapshot>& states, const TraceSpan& span) : states_(states), span_(span) {}

  void take(const Cell& cell) {
    const Tick tick = cell.state().tick;
    const bool is_new = states_.empty() || tick > states_.back().state.tick;
    if (cell.epoch() == span_.epoch && tick >= span_.from && tick <= span_.to && is_new)
      add(cell.snapshot());
  }

  /// For time that has passed within an input.
  void take_if_due(const Cell& cell) {
    if (states_.empty() || cell.state().tick >= states_.back().state.tick + span_.every) take(cell);
  }

 private:
  void add(Snapshot&& now) {
    const std::size_t count = states_.size();
    const bool is_third = count > 1 && is_same_but_time(states_[count - 2], states_.back()) &&
                          is_same_but_time(states_.back(), now);
    if (is_third) {
      states_.back() = std::move(now);
    } else {
      states_.push_back(std::move(now));
    }
  }

  std::vector<Snapshot>& states_;
  TraceSpan span_;
};

}  // namespace

PastTrace trace_past(const recording::Header& header, const HistoryPart& part,
                     const TraceSpan& span) {
  assert(span.every > 0 && span.from <= span.to);
  assert(!(ReplayTime{span.epoch, span.from} < part.from()));
  PastTrace trace;
  const std::unique_ptr<Cell> cell = cell_at_start(header, part);
  Sampler sampler(trace.states, span);
  Replayer replayer(*cell, Compared::kNothing);
  replayer.sample_every(span.every, [&](const Cell& its) { sampler.take(its); });
  replayer.stop_at({span.epoch, span.to});
  part.inputs.for_each([&](const recording::Entry& entry) {
    trace.difference = replayer.apply(entry);
    sampler.take_if_due(*cell);
    return !trace.difference && !replayer.is_stopped();
  });
  replayer.run_to_stop();
  sampler.take(*cell);
  return trace;
}

}  // namespace xr3
