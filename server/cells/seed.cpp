#include "server/cells/seed.hpp"

#include <utility>

#include "protocol/files/faults.hpp"
#include "server/files/data_files.hpp"
#include "server/files/load_model.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

void start_time(const ServeOptions& options, Cell& cell) {
  if (options.clock.mode == ClockMode::kBytes) {
    cell.set_byte_clock(byte_clock_settings(options), options.line_speed);
  } else if (options.line_speed) {
    cell.set_line_speed(*options.line_speed);
  }
}

}  // namespace

CellSeed load_seed(const ServeOptions& options, const std::string& robot,
                   const std::string& workcell) {
  CellSeed seed;
  seed.model = load_model({robot, workcell, options.profile, options.option_sources});
  if (options.fault_file.empty()) return seed;
  const DataFile file = with_option_source(options.option_sources, "--fault", [&] {
    return find_data_file(options.fault_file, "faults");
  });
  seed.faults = load_faults(file.text, file.path, seed.model->labels());
  return seed;
}

std::shared_ptr<const LiveExercise> load_live_exercise(const ServeOptions& options,
                                                       const CellSeed& seed) {
  if (options.goals.empty()) return nullptr;
  GoalList goals = with_option_source(options.option_sources, "--goals",
                                      [&] { return load_goal_list(options.goals, *seed.model); });
  return std::make_shared<const LiveExercise>(
      live_exercise(options.exercise_title, std::move(goals), seed.model, seed.faults));
}

ByteClockSettings byte_clock_settings(const ServeOptions& options) {
  ByteClockSettings settings = options.clock.bytes;
  settings.has_concurrent_lines = options.has_concurrent_lines;
  return settings;
}

SimClock start_clock(const ClockChoice& choice) {
  switch (choice.mode) {
    case ClockMode::kReal: break;
    case ClockMode::kManual: return SimClock::manual();
    case ClockMode::kBytes: return SimClock::bytes();
  }
  return SimClock::real(choice.rate, wall_now());
}

CellPtr make_cell(CellContext& context, const ServeOptions& options, const CellSeed& seed,
                  std::string name, EventSink sink, std::string token) {
  CellPtr cell = HostedCell::make(context, {std::move(name), seed.model, start_clock(options.clock),
                                            std::move(sink), std::move(token)});
  start_time(options, cell->cell());
  if (seed.faults) cell->cell().set_faults(*seed.faults);
  if (seed.exercise) cell->follow_goals(seed.exercise);
  return cell;
}

}  // namespace xr3
