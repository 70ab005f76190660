// The monitor's calls as values: operations on a cell, and their outcomes. Independent of JSON.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "core/command.hpp"
#include "core/robot.hpp"
#include "core/sim_clock.hpp"
#include "core/state.hpp"
#include "core/workcell.hpp"

namespace xr3 {

/// A cell's state and workcell as kept in a snapshot, without lines and clock. A cell with the same
/// robot and profile that loads it continues bit-identically.
struct SavedCell {
  std::string robot_hash;  ///< hash of robot and profile, see cell/digest.hpp
  Workcell workcell;       ///< from the file or from the last call `workcell`
  State state;
  bool operator==(const SavedCell&) const = default;
};
using SavedCellPtr = std::shared_ptr<const SavedCell>;

}  // namespace xr3

namespace xr3::call {

/// Switches the clock to manual mode.
struct Pause {};
/// Switches the clock to real mode: it follows wall time.
struct Resume {};
struct SetRate {
  Rate rate;  ///< kSlowest...kFastest
};
/// Advances a manual clock by `ticks`, at least 0.
struct Step {
  Tick ticks = 0;
};
/// Advances a manual clock until the cell is at rest or until a tick, by at most max_ticks.
struct RunUntil {
  std::optional<Tick> tick;  ///< nullopt to run until the cell is at rest
  Tick max_ticks = 0;
};
/// Restores the initial state and begins a new epoch at tick 0. Lines stay open, their parsers are
/// reset. A workcell that replaced the file's is kept.
struct Reset {};
/// Equivalent to A$ on a line.
struct Home {};
/// A function of command mode (paper, Table IV). Available even while the controller is disabled.
struct Key {
  Command command;  ///< display, view vector, home, status option, enable, function keys, path
};
/// Stops all joints of the physical controller, even while the simulator is enabled.
struct StopDevice {};
/// Aligns the simulation with the arm of the physical controller, which is at its soft home.
struct AlignMirror {};
struct SetInput {
  int input = 1;  ///< 1...8
  bool value = false;
};
struct AddBlock {
  Block block;
};
struct MoveBlock {
  std::string name;
  std::optional<PointUm> centroid_um;  ///< nullopt if unchanged, also for yaw_udeg
  std::optional<Microdegrees> yaw_udeg;
};
struct RemoveBlock {
  std::string name;
};
/// Replaces the workcell. The robot's state is kept; a held block disappears with the old workcell.
struct ReplaceWorkcell {
  Workcell workcell;
};
/// Saves under `name`; if it is empty, the snapshot is only returned in the result.
struct SaveSnapshot {
  std::string name;
};
/// Loads the snapshot saved under `name` or the one passed with the call. Begins a new epoch.
struct LoadSnapshot {
  std::string name;
  SavedCellPtr saved;  ///< used if `name` is empty
};
/// Adds a fault, or replaces the one with its name.
struct SetFault {
  Fault fault;
  std::optional<std::uint64_t> seed;  ///< seed of all faults; nullopt if unchanged
};
/// Removes a fault, or all faults.
struct ClearFault {
  std::string name;  ///< empty for all faults
};

using Call = std::variant<Pause, Resume, SetRate, Step, RunUntil, Reset, Home, Key, StopDevice,
                          AlignMirror, SetInput, AddBlock, MoveBlock, RemoveBlock, ReplaceWorkcell,
                          SaveSnapshot, LoadSnapshot, SetFault, ClearFault>;

/// A call that was executed.
struct Done {
  std::optional<bool> reached;    ///< run_until only
  std::optional<Tick> ran_ticks;  ///< run_until only
  SavedCellPtr saved;             ///< snapshot_save and snapshot_load only
};

/// A call that was refused and has changed nothing.
struct Refused {
  std::string code;  ///< stable, such as `clock_running`
  std::string message;
  std::string hint;
};

using Outcome = std::variant<Done, Refused>;

}  // namespace xr3::call
