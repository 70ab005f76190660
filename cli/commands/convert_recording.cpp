#include "cli/commands/convert_recording.hpp"

#include <filesystem>
#include <optional>

#include "cli/commands/fail.hpp"
#include "cli/commands/replay_run.hpp"
#include "cli/mcap/foxglove_messages.hpp"
#include "cli/mcap/sampler.hpp"
#include "cli/mcap/zstd.hpp"
#include "protocol/text/printable.hpp"
#include "protocol/text/table.hpp"
#include "server/files/atomic_write.hpp"
#include "server/print.hpp"

namespace xr3 {
namespace {

constexpr ::mode_t kOwnerOnly = 0600;  // as for recordings

ExitCode refuse_existing(const std::string& out) {
  return fail(ExitCode::kBadInput, out + ": already exists; --force replaces it");
}

std::string summary_of(const FoxgloveMessages& messages) {
  constexpr double kNsPerSecond = 1e9;
  const double seconds = static_cast<double>(messages.latest_time()) / kNsPerSecond;
  return std::to_string(messages.count()) + " messages in " + plain_number(seconds) + " s";
}

/// Repeats the recording and writes it. Returns a summary; nullopt if the replay differs.
std::optional<std::string> write_messages(const ConvertOptions& options, Draft& draft) {
  ReplayOptions replay;
  replay.file = options.in;
  ReplayRun run(replay);
  const recording::Header& header = run.header();
  Cell cell(header.cell, header.model, replay_clock(header));
  prepare_replay(cell, header);
  const auto append = [&](std::string_view bytes) { draft.append(bytes); };
  mcap::McapWriter writer(append, "xr3 " XR3_VERSION, mcap_channels(cell.model()),
                          zstd_compression());
  FoxgloveMessages messages(options.in, cell.model(), writer);
  CellSampler sampler(cell, options.every_ms.value_or(kUsualEveryMs), messages);
  if (!run.repeat(cell)) return std::nullopt;
  sampler.finish();
  writer.finish();
  return summary_of(messages);
}

}  // namespace

ExitCode convert_recording(const ConvertOptions& options) {
  ignore_signals_of_writing();
  std::error_code ignored;
  if (!options.force && std::filesystem::exists(options.out, ignored))
    return refuse_existing(options.out);
  Draft draft(options.out, kOwnerOnly);
  const auto summary = write_messages(options, draft);
  if (!summary) return ExitCode::kDifferent;
  draft.sync();
  if (!draft.take_name(options.force ? Existing::kReplace : Existing::kKeep))
    return refuse_existing(options.out);
  print_text(printable_line(options.out + ": " + *summary) + "\n");
  return ExitCode::kGood;
}

}  // namespace xr3
