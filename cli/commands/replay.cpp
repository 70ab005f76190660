#include <optional>
#include <utility>

#include "cell/recording/continued.hpp"
#include "cell/recording/replayer.hpp"
#include "cli/commands/commands.hpp"
#include "cli/commands/fail.hpp"
#include "core/drawing/status_line.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/snapshot.hpp"
#include "protocol/text/printable.hpp"
#include "server/app.hpp"
#include "server/files/atomic_write.hpp"
#include "server/log.hpp"
#include "server/print.hpp"
#include "server/recording/joint_table.hpp"
#include "server/recording/source.hpp"
#include "tools/drawing/picture.hpp"
#include "tools/drawing/svg.hpp"

namespace xr3 {
namespace {

std::string time_text(const Cell& cell) {
  return "epoch " + std::to_string(cell.epoch()) + ", tick " + std::to_string(cell.state().tick);
}

/// Repeats a recording on a fresh cell.
class ReplayRun {
 public:
  explicit ReplayRun(const ReplayOptions& options)
      : options_(options), source_(options.file), header_(source_.header()) {}

  const recording::Header& header() const { return header_; }

  /// Returns whether all inputs had the recorded results; if not, prints the first difference.
  bool repeat(Cell& cell) {
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

 private:
  bool apply_all(Replayer& replayer) {
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
  void add_row(JointTable& table, const Cell& cell) const {
    if (table.is_full())
      throw FileError(options_.csv + ": the table would have more than " +
                      std::to_string(JointTable::kMaxRows) + " lines; with a longer --every (now " +
                      std::to_string(options_.every_ms) + " ms) it has fewer");
    table.add(cell, cell.state().tick);
  }
  /// Requires the time to stop to be one that the cell had.
  void require_stop(const Cell& cell) const {
    if (!options_.until) return;
    if (cell.epoch() == options_.until->epoch && cell.state().tick == options_.until->tick) return;
    throw FileError(options_.file + ": the recording has no tick " +
                    std::to_string(options_.until->tick) + " of epoch " +
                    std::to_string(options_.until->epoch) + "; it came to " + time_text(cell));
  }
  void report(const Cell& cell, const Replayer& replayer) const {
    const recording::RecordingReader& reader = source_.reader();
    if (reader.cut_off() > 0)
      note("the last line is incomplete; the recording ends at line " +
           std::to_string(reader.line()));
    if (!replayer.is_stopped() && !reader.is_whole())
      note("the recording was cut off: it has no last entry");
    note(std::to_string(replayer.inputs()) + " inputs repeated up to " + time_text(cell) +
         "; everything is as recorded");
  }

  void note(const std::string& text) const {
    print_error(printable_line(options_.file + ": " + text) + "\n");
  }

  const ReplayOptions& options_;
  RecordingSource source_;
  recording::Header header_;
};

void print_state(const Cell& cell) {
  const std::string members = monitor::text_of(state_json(cell.model(), cell.snapshot()));
  print_json(*monitor::channel_message(monitor::Channel::kState,
                                       {cell.name(), cell.epoch(), 0, cell.state().tick}, members) +
             "\n");
}

void show_end(const ReplayOptions& options, const Cell& cell) {
  if (options.print == ReplayPrint::kState) print_state(cell);
  if (options.print == ReplayPrint::kStatus)
    print_text(printable_line(status_line(cell.model(), cell.state())) + "\n");
  if (options.svg.empty()) return;
  const State& state = cell.state();
  const Picture picture = drawing(cell.model(), state, state.display.view, kUsualPictureWidthPx);
  write_file(options.svg, to_svg(picture));
}

ExitCode replay_file(const ReplayOptions& options) {
  ReplayRun run(options);
  const recording::Header& header = run.header();
  Cell cell(header.cell, header.model, replay_clock(header));
  prepare_replay(cell, header);
  if (!run.repeat(cell)) return ExitCode::kDifferent;
  show_end(options, cell);
  return ExitCode::kGood;
}

ExitCode replay_and_serve(const ReplayCommand& command) {
  ignore_signals_of_writing();
  ServeOptions server = command.server;
  with_option_source(server.option_sources, "--log-file",
                     [&] { start_log(server.log_level, server.log_file); });
  const std::string token = with_option_source(server.option_sources, "--token-file",
                                               [&] { return read_token(server.token); });
  ReplayRun run(command.replay);
  const recording::Header& header = run.header();
  if (header.device)
    throw FileError(command.replay.file +
                    ": --serve cannot go on from a recording with a physical controller");
  const ByteClockSettings bytes = header.byte_clock.value_or(ByteClockSettings{});
  server.clock = {header.mode, header.rate, bytes};
  server.has_concurrent_lines = bytes.has_concurrent_lines;
  server.line_speed = header.line_speed;
  server.profile = header.model->profile();
  server.history_ticks = kMaxHistory;  // the whole recording, as far as it fits
  App app(server, {CellSeed{header.model, header.faults}}, token);
  bool is_same = false;
  app.begin_with([&](Cell& cell) {
    if (header.start) begin_at_start(cell, header, 0);
    is_same = run.repeat(cell);
    if (is_same) show_end(command.replay, cell);
  });
  return is_same ? app.run() : ExitCode::kDifferent;
}

}  // namespace

ExitCode run_command(const ReplayCommand& command) {
  return command.replay.is_serving ? replay_and_serve(command) : replay_file(command.replay);
}

}  // namespace xr3
