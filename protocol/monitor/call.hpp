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

/// The properties of a call beside its effect. A call without a function traits() has none.
struct Traits {
  bool moves_time = false;        ///< may wait for bytes; the result has the state
  bool begins_epoch = false;      ///< unless refused
  bool enlarges = false;          ///< can make the cell larger for good
  bool works_in_past = false;     ///< permitted while the cell is in its past
  bool keeps_transcript = false;  ///< the transcript stays a function of the bytes, or begins anew
  bool returns_faults = false;    ///< the result has the list of faults
  bool is_for_teachers = false;   ///< a token of the cell alone does not suffice
};

/// Switches the clock to manual mode.
struct Pause {};
/// Switches the clock to real mode: it follows wall time.
struct Resume {
  static constexpr Traits traits() { return {.works_in_past = true}; }
};
/// Stops time for a lesson: nothing but Unfreeze makes it pass again.
struct Freeze {
  static constexpr Traits traits() { return {.works_in_past = true, .is_for_teachers = true}; }
};
/// Time passes again as before the Freeze.
struct Unfreeze {
  static constexpr Traits traits() { return {.works_in_past = true, .is_for_teachers = true}; }
};
/// Tells those who follow the cell's events something. It changes nothing else.
struct SayNotice {
  static constexpr std::size_t kMaxText = 500;
  std::string text;  ///< 1 to kMaxText characters
  static constexpr Traits traits() {
    return {.works_in_past = true, .keeps_transcript = true, .is_for_teachers = true};
  }
};
struct SetRate {
  Rate rate;  ///< kSlowest...kFastest
};
/// Advances a manual clock by `ticks`, at least 0.
struct Step {
  Tick ticks = 0;
  static constexpr Traits traits() { return {.moves_time = true}; }
};
/// Advances a manual clock until the cell is at rest or until a tick, by at most max_ticks.
struct RunUntil {
  std::optional<Tick> tick;  ///< nullopt to run until the cell is at rest
  Tick max_ticks = 0;
  static constexpr Traits traits() { return {.moves_time = true}; }
};
/// Restores the initial state and begins a new epoch at tick 0. Lines stay open, their parsers are
/// reset. A workcell that replaced the file's is kept.
struct Reset {
  static constexpr Traits traits() { return {.begins_epoch = true, .keeps_transcript = true}; }
};
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
  static constexpr Traits traits() { return {.enlarges = true}; }
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
  static constexpr Traits traits() { return {.enlarges = true}; }
};
/// Saves under `name`; if it is empty, the snapshot is only returned in the result.
struct SaveSnapshot {
  std::string name;
  Traits traits() const {
    return {.enlarges = !name.empty(), .works_in_past = true, .keeps_transcript = true};
  }
};
/// Loads the snapshot saved under `name` or the one passed with the call. Begins a new epoch.
struct LoadSnapshot {
  std::string name;
  SavedCellPtr saved;  ///< used if `name` is empty
  static constexpr Traits traits() {
    return {.begins_epoch = true, .enlarges = true, .keeps_transcript = true};
  }
};
/// Adds a fault, or replaces the one with its name.
struct SetFault {
  Fault fault;
  std::optional<std::uint64_t> seed;  ///< seed of all faults; nullopt if unchanged
  static constexpr Traits traits() { return {.returns_faults = true}; }
};
/// Removes a fault, or all faults.
struct ClearFault {
  std::string name;  ///< empty for all faults
  static constexpr Traits traits() { return {.returns_faults = true}; }
};

using Call =
    std::variant<Pause, Resume, Freeze, Unfreeze, SayNotice, SetRate, Step, RunUntil, Reset, Home,
                 Key, StopDevice, AlignMirror, SetInput, AddBlock, MoveBlock, RemoveBlock,
                 ReplaceWorkcell, SaveSnapshot, LoadSnapshot, SetFault, ClearFault>;

inline Traits traits_of(const Call& call) {
  return std::visit(
      [](const auto& each) {
        if constexpr (requires { each.traits(); }) return each.traits();
        return Traits{};
      },
      call);
}

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
