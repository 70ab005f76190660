// One robot with its serial lines as a value: what rewinding takes back, and what it keeps. The
// functions of this folder change it: apply.hpp for inputs, advance.hpp for time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "cell/agenda.hpp"
#include "cell/byte_clock.hpp"
#include "cell/counters.hpp"
#include "cell/device/link.hpp"
#include "cell/device/mirror.hpp"
#include "cell/input.hpp"
#include "cell/line/serial_line.hpp"
#include "cell/transcript.hpp"
#include "cell/warning_limiter.hpp"
#include "core/sim_clock.hpp"
#include "core/simulation.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/explain/contest.hpp"

namespace xr3 {

/// The due bytes that were executed or sent in one tick.
struct DueBytes {
  Tick tick = 0;
  std::size_t count = 0;
  void add(Tick now) {
    count = now == tick ? count + 1 : 1;
    tick = now;
  }
  bool operator==(const DueBytes&) const = default;
};

/// The cell was taken back to its past, and waits there.
struct InPast {
  bool was_manual = false;  ///< the clock, before
  bool operator==(const InPast&) const = default;
};

/// The call Freeze has stopped time. Only the call Unfreeze starts it again.
struct Frozen {
  bool was_manual = false;  ///< the clock, before
  bool operator==(const Frozen&) const = default;
};

/// Everything that the cell's future depends on beside its inputs and its settings: a copy is a
/// checkpoint, from which recorded inputs can be repeated bit-identically.
struct Rewindable {
  Simulation machine;
  SimClock clock;
  Epoch epoch = 0;
  int model_rev = 1;                          ///< editing or replacing the workcell increments it
  std::optional<ByteClock> byte_clock = {};   ///< nullopt: time does not follow bytes
  std::optional<Transcript> transcript = {};  ///< of this epoch, for a byte clock
  Agenda agenda = {};
  std::map<LineId, SerialLine> lines = {};  ///< the open ones
  LineId last_line = 0;                     ///< that was opened; 0: none
  std::map<std::string, MachineSnapshotPtr> snapshots = {};
  DueBytes due_bytes = {};
  std::optional<InPast> in_past = {};
  std::optional<Frozen> frozen = {};
  bool operator==(const Rewindable&) const = default;
};

/// What rewinding does not take back: the settings, the world outside, and statistics.
struct NotRewound {
  std::string name;
  FaultPlan initial_faults = {};  ///< those of the start, and of each reset
  std::optional<LineSpeed> line_speed = {};
  /// Digest of the files with which it once began, if it has gone on from a recording; else empty.
  std::string origin = {};
  bool is_replayed = false;   ///< time passes by the entries of a recording alone
  std::optional<DeviceLink> device = {};
  std::optional<Mirror> mirror = {};
  WarningLimiter warnings = {};
  ContestObserver contests = {};
  std::map<LineId, std::uint64_t> closed_bytes_in = {};  ///< of closed lines, the latest
  std::optional<Tick> last_input_tick = {};              ///< in this epoch
  CellCounters counters = {};
  bool operator==(const NotRewound&) const = default;
};

struct CellState : Rewindable, NotRewound {
  const Model& model() const { return machine.model(); }
  /// The state of the machine.
  const State& state() const { return machine.state(); }
  Tick tick() const { return machine.tick(); }

  /// nullptr if closed.
  const SerialLine* find_line(LineId line) const {
    const auto found = lines.find(line);
    return found == lines.end() ? nullptr : &found->second;
  }
  SerialLine* find_line(LineId line) {
    const auto found = lines.find(line);
    return found == lines.end() ? nullptr : &found->second;
  }
  /// Nothing moves, and no byte of a line is due.
  bool is_at_rest() const { return machine.is_at_rest() && agenda.empty(); }
  /// Bytes move time: the byte clock runs.
  bool is_moved_by_bytes() const { return byte_clock && clock.mode() == ClockMode::kBytes; }
  /// With a device, commands go there, not to the machine.
  bool is_engaged() const { return device && device->is_engaged(); }
  bool operator==(const CellState&) const = default;
  /// The model of this robot and profile with another workcell.
  ModelPtr model_with(const Workcell& workcell) const {
    return std::make_shared<const Model>(model().robot(), workcell, model().profile());
  }
};

}  // namespace xr3
