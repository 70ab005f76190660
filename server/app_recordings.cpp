// The recordings of the cells: begun at the start, or where the last ones end; and their past.
#include <spdlog/spdlog.h>

#include <chrono>

#include "server/app.hpp"
#include "server/net/wall_clock.hpp"
#include "server/recording/folder.hpp"

namespace xr3 {
namespace {

auto system_now() { return std::chrono::system_clock::now(); }

}  // namespace

void App::start_recordings() {
  if (options_.record.empty()) return;
  with_option_source(options_.option_sources, "--record", [&] {
    has_many_cells(options_) ? start_recordings_of_class() : start_recording_of_one();
  });
}

void App::start_recording_of_one() {
  record_path_ = unused_path(options_.record, system_now());
  if (record_path_ != options_.record)
    spdlog::info("{} exists already; the cell is recorded in {}", options_.record, record_path_);
  record(first());
}

void App::start_recordings_of_class() {
  make_recording_folder(options_.record);
  spdlog::info("the cells are recorded in {}", options_.record);
  for (const CellPtr& each : cells_.all()) {
    const auto last =
        options_.is_continued ? newest_recording(options_.record, each->name()) : std::nullopt;
    last ? comebacks_.add(each, *last) : record(*each);
  }
  retention_.begin();
}

void App::record(HostedCell& cell) {
  const RecordingLimits limits{std::uint64_t{options_.record_max_mib} << 20U, &record_room_};
  if (!has_many_cells(options_)) return cell.record(record_path_, limits);
  const auto new_path = [this, name = cell.name()] {
    return new_recording_path(options_.record, name, system_now());
  };
  cell.record_daily(new_path, limits);
}

// Begins the recording of a cell while the server runs. If that fails, the cell continues without
// it.
void App::record_or_report(HostedCell& cell) {
  if (options_.record.empty()) return;
  try {
    record(cell);
  } catch (const FileError& error) {
    cell.cell().apply(RecordingFailed{options_.record + "/" + cell.name(), error.what()},
                      wall_now());
  }
}

// A cell has gone on from its last recording, or cannot.
void App::begin_again(HostedCell& cell) {
  record_or_report(cell);
  keep_history(cell);
}

// --- The past.

void App::keep_histories() {
  for (const CellPtr& each : cells_.all())
    if (!each->is_absent()) keep_history(*each);
}

void App::keep_history(HostedCell& cell) {
  if (options_.history_ticks > 0 && cell.cell().device() == nullptr && cell.history() == nullptr)
    cell.keep_history(options_.history_ticks);
}

}  // namespace xr3
