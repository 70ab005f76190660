// The inputs of a cell, as values: lines that open and close, their bytes, and calls of the
// monitor. Sessions create them; only apply() accepts them. Those that a recording holds as
// they are stand in protocol/recording/entry.hpp.
#pragma once

#include <compare>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/model.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/line/line_guard.hpp"
#include "protocol/monitor/call.hpp"
#include "protocol/recording/entry.hpp"

namespace xr3 {

struct LineOpened {
  std::string peer;  ///< for display: address and port, or `monitor`
  LineKind kind = LineKind::kTcp;
  Guard guard = Guard::kNormal;
};

struct BytesIn {
  LineId line = 0;
  std::string_view bytes;
};

/// The physical controller has sent bytes. Precondition of this and the other inputs of the device:
/// the cell has one.
struct DeviceIn {
  std::string_view bytes;
};

/// State and workcell of a cell.
struct MachineSnapshot {
  ModelPtr model;
  State state;
};
using MachineSnapshotPtr = std::shared_ptr<const MachineSnapshot>;

/// A moment in the life of a cell. Ordered by epoch, then tick.
struct ReplayTime {
  Epoch epoch = 0;
  Tick tick = 0;
  auto operator<=>(const ReplayTime&) const = default;
};

/// The cell is taken back to a state of its past, with the same robot and profile: see
/// take_back(). Precondition: it has no device.
struct Rewind {
  MachineSnapshotPtr past;
  ReplayTime from{};  ///< the time of that state, for the history
};

/// The recording of the cell's inputs has ended before the cell has, or could not begin. For event
/// and counter; it changes nothing else.
struct RecordingFailed {
  std::string path;  ///< of its file
  std::string why;   ///< begins with the path
};

/// The transport has sent bytes of the line's outbox. Time does not advance for it.
struct BytesOut {
  LineId line = 0;
  std::size_t count = 0;
};

using Input = std::variant<LineOpened, LineSettings, BytesIn, BytesOut, InputEnded, LineClosed,
                           LineSilent, DeviceOpened, DeviceLost, DeviceIn, DeviceOut, Rewind,
                           RecordingFailed, call::Call>;

/// The line of an input of an open line; nullopt for others.
std::optional<LineId> line_of(const Input& input);

/// The result of an input: the number of the opened line, the number of bytes taken, or the outcome
/// of the call.
struct Applied {
  LineId line = 0;
  std::size_t bytes_taken = 0;
  call::Outcome outcome = {};
};

}  // namespace xr3
