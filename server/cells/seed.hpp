// The parts with which a cell begins, and functions that make a fresh cell of them as the options
// of `serve` say.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/faults/fault.hpp"
#include "core/model.hpp"
#include "server/cells/hosted_cell.hpp"
#include "server/options/options.hpp"

namespace xr3 {

/// One for each cell of the start, and one for all cells of connections.
struct CellSeed {
  ModelPtr model;
  std::optional<FaultPlan> faults;
  std::shared_ptr<const LiveExercise> exercise = {};  ///< nullptr without goals
};

/// Loads the files of a cell. Throws FileError and DataError.
CellSeed load_seed(const ServeOptions& options, const std::string& robot,
                   const std::string& workcell);

/// The exercise whose goals the options name, for the robot of this seed; nullptr if there is none.
/// Throws FileError and DataError.
std::shared_ptr<const LiveExercise> load_live_exercise(const ServeOptions& options,
                                                       const CellSeed& seed);

/// The rules of the byte clock that the options choose.
ByteClockSettings byte_clock_settings(const ServeOptions& options);

/// The clock of a cell that starts now.
SimClock start_clock(const ClockChoice& choice);

/// A cell without ports, with the clock, the line speed and the faults of the options and the seed.
/// `token`: empty if it has none.
CellPtr make_cell(CellContext& context, const ServeOptions& options, const CellSeed& seed,
                  std::string name, EventSink sink, std::string token = {});

}  // namespace xr3
