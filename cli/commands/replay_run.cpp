#include "cli/commands/replay_run.hpp"

#include <optional>

#include "protocol/text/printable.hpp"
#include "server/print.hpp"

namespace xr3 {
namespace {

std::string time_text(const Cell& cell) {
  return "epoch " + std::to_string(cell.epoch()) + ", tick " + std::to_string(cell.state().tick);
}

}  // namespace

bool ReplayRun::repeat(Cell& cell) {
  const bool compares = header_.state_format == kStateFormat;
  if (!compares)
    note("the digests of the state are not compared: they have format " +
         std::to_string(header_.state_format) + ", and this version of xr3 makes format " +
         std::to_string(kStateFormat));
  Replayer replayer(cell, compares ? Compared::kAll : Compared::kReplies);
  if (options_.until) replayer.stop_at(*options_.until);
  std::optional<JointTable> table;
  if (!options_.csv.empty()) {
    table.emplace(*header_.model, options_.csv);
    replayer.sample_every(options_.every_ms, [&](const Cell& its) { add_row(*table, its); });
  }
  if (!apply_all(replayer)) return false;
  replayer.run_to_stop();
  if (table) table->finish();
  require_stop(cell);
  report(cell, replayer);
  return true;
}

bool ReplayRun::apply_all(Replayer& replayer) {
  while (!replayer.is_stopped()) {
    const auto entry = source_.next();
    if (!entry) break;
    if (const auto other = replayer.apply(*entry)) {
      print_error(printable_line(options_.file + ":" + std::to_string(source_.reader().line()) +
                                 ": " + to_text(*other)) +
                  "\n");
      return false;
    }
  }
  return true;
}

void ReplayRun::add_row(JointTable& table, const Cell& cell) const {
  if (table.is_full())
    throw FileError(options_.csv + ": the table would have more than " +
                    std::to_string(JointTable::kMaxRows) + " lines; with a longer --every (now " +
                    std::to_string(options_.every_ms) + " ms) it has fewer");
  table.add(cell, cell.state().tick);
}

/// Requires the time to stop to be one that the cell had.
void ReplayRun::require_stop(const Cell& cell) const {
  if (!options_.until) return;
  if (cell.epoch() == options_.until->epoch && cell.state().tick == options_.until->tick) return;
  throw FileError(options_.file + ": the recording has no tick " +
                  std::to_string(options_.until->tick) + " of epoch " +
                  std::to_string(options_.until->epoch) + "; it came to " + time_text(cell));
}

void ReplayRun::report(const Cell& cell, const Replayer& replayer) const {
  const recording::RecordingReader& reader = source_.reader();
  if (reader.cut_off() > 0)
    note("the last line is incomplete; the recording ends at line " +
         std::to_string(reader.line()));
  if (!replayer.is_stopped() && !reader.is_whole())
    note("the recording was cut off: it has no last entry");
  note(std::to_string(replayer.inputs()) + " inputs repeated up to " + time_text(cell) +
       "; everything is as recorded");
}

void ReplayRun::note(const std::string& text) const {
  print_error(printable_line(options_.file + ": " + text) + "\n");
}

}  // namespace xr3
