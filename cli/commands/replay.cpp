#include <optional>
#include <utility>

#include "cell/recording/continued.hpp"
#include "cell/recording/replayer.hpp"
#include "cli/commands/commands.hpp"
#include "cli/commands/fail.hpp"
#include "cli/commands/replay_run.hpp"
#include "core/drawing/status_line.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/snapshot.hpp"
#include "protocol/text/printable.hpp"
#include "server/app.hpp"
#include "server/files/atomic_write.hpp"
#include "server/log.hpp"
#include "server/print.hpp"
#include "tools/drawing/picture.hpp"
#include "tools/drawing/svg.hpp"

namespace xr3 {
namespace {

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
