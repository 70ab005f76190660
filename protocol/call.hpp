// The monitor's calls as values: what a client may do to a cell, and what comes of it. No JSON here.
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

/// A cell's state and workcell as a snapshot keeps them: neither lines nor clock. Loaded into a cell
/// with the same robot and profile it gives the same continuation, bit for bit.
struct SavedCell {
  std::string robot_hash;  ///< of robot and profile, see server/model_hash
  Workcell workcell;       ///< as the files or a `workcell` call gave it
  State state;
  bool operator==(const SavedCell&) const = default;
};
using SavedCellPtr = std::shared_ptr<const SavedCell>;

}  // namespace xr3

namespace xr3::call {

/// Time stands until resume (clock mode manual).
struct Pause {};
/// Time follows the wall clock again (clock mode real).
struct Resume {};
struct SetRate {
  Rate rate;  ///< kSlowest...kFastest
};
/// So many ticks in standing time, 0 and up.
struct Step {
  Tick ticks = 0;
};
/// Standing time runs until the cell is at rest, or until a tick, but for at most max_ticks.
struct RunUntil {
  std::optional<Tick> tick;  ///< none: until the cell is idle
  Tick max_ticks = 0;
};
/// The state as the files say; a new epoch begins at tick 0. Lines stay, their parsers are emptied; a
/// workcell that replaced the file's stays.
struct Reset {};
/// The same as A$ on a line.
struct Home {};
/// A function of command mode (paper, Table IV), which also works while the controller is disabled.
struct Key {
  Command command;  ///< display, view vector, home, status option, enable, function keys, path
};
struct SetInput {
  int input = 1;  ///< 1...8
  bool value = false;
};
struct AddBlock {
  Block block;
};
struct MoveBlock {
  std::string name;
  std::optional<PointUm> centroid_um;  ///< none: where it is
  std::optional<Microdegrees> yaw_udeg;
};
struct RemoveBlock {
  std::string name;
};
/// The robot stays as it is, held blocks fall away with the old workcell.
struct ReplaceWorkcell {
  Workcell workcell;
};
/// Under a name, or, where it is empty, only into the answer.
struct SaveSnapshot {
  std::string name;
};
/// One that was saved under a name, or one that came with the call. A new epoch begins.
struct LoadSnapshot {
  std::string name;
  SavedCellPtr saved;  ///< where there is no name
};

using Call =
    std::variant<Pause, Resume, SetRate, Step, RunUntil, Reset, Home, Key, SetInput, AddBlock,
                 MoveBlock, RemoveBlock, ReplaceWorkcell, SaveSnapshot, LoadSnapshot>;

/// A call that was carried out.
struct Done {
  std::optional<bool> reached;    ///< run_until only
  std::optional<Tick> ran_ticks;  ///< run_until only
  SavedCellPtr saved;             ///< snapshot_save and snapshot_load only
};

/// A call that was refused; nothing was changed.
struct Refused {
  std::string code;  ///< stable, as in `clock_running`
  std::string message;
  std::string hint;
};

using Outcome = std::variant<Done, Refused>;

}  // namespace xr3::call
