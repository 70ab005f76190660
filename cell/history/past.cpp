#include "cell/history/past.hpp"

#include "cell/recording/replayer.hpp"

namespace xr3 {

std::unique_ptr<Cell> cell_at_start(const recording::Header& header, const HistoryPart& part) {
  auto cell = std::make_unique<Cell>(header.cell, header.model, replay_clock(header));
  prepare_replay(*cell, header);
  cell->restore(part.start);
  return cell;
}

Past make_past(const recording::Header& header, const HistoryPart& part, const ReplayTime& time) {
  Past past{cell_at_start(header, part), {}};
  Replayer replayer(*past.cell, Compared::kNothing);
  replayer.stop_at(time);
  part.inputs.for_each([&](const recording::Entry& entry) {
    past.difference = replayer.apply(entry);
    return !past.difference && !replayer.is_stopped();
  });
  replayer.run_to_stop();
  return past;
}

}  // namespace xr3
