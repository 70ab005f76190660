#include "cell/history/trace.hpp"

#include <cassert>
#include <memory>
#include <utility>

#include "cell/history/past.hpp"
#include "cell/recording/replayer.hpp"
#include "protocol/monitor/snapshot.hpp"

namespace xr3 {
namespace {

bool is_same_but_tick(const Json& a, const Json& b) {
  return a["joints"] == b["joints"] && a["tool"] == b["tool"];
}

/// Takes the states, and leaves out those between two equal ones.
class Sampler {
 public:
  Sampler(Json& states, const TraceSpan& span) : states_(states), span_(span) {}

  void take(const Cell& cell) {
    const Tick tick = cell.state().tick;
    const bool is_new = tick > last_.value_or(-1);
    if (cell.epoch() == span_.epoch && tick >= span_.from && tick <= span_.to && is_new)
      add(tick, state_json(cell.model(), cell.snapshot(), Fields{{"joints", "tool"}}));
  }

  /// For time that has passed within an input.
  void take_if_due(const Cell& cell) {
    if (!last_ || cell.state().tick >= *last_ + span_.every) take(cell);
  }

 private:
  void add(Tick tick, Json&& state) {
    last_ = tick;
    state["tick"] = tick;
    const std::size_t count = states_.size();
    const bool is_third = count > 1 && is_same_but_tick(states_[count - 2], states_[count - 1]) &&
                          is_same_but_tick(states_[count - 1], state);
    if (is_third) {
      states_[count - 1] = std::move(state);
    } else {
      states_.push_back(std::move(state));
    }
  }

  Json& states_;
  TraceSpan span_;
  std::optional<Tick> last_;  ///< that was taken
};

}  // namespace

PastTrace trace_past(const recording::Header& header, const HistoryPart& part,
                     const TraceSpan& span) {
  assert(span.every > 0 && span.from <= span.to);
  assert(!(ReplayTime{span.epoch, span.from} < part.from()));
  PastTrace trace;
  trace.to = span.to;
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
