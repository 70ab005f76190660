// The inputs of a cell, as values: lines that open and close, their bytes, and calls of the
// monitor. Sessions create them; only Cell::apply accepts them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "cell/recording/replay_time.hpp"
#include "cell/serial_line.hpp"
#include "core/model.hpp"
#include "protocol/monitor/call.hpp"

namespace xr3 {

/// The line of the server's own readiness probe (`RobotProbe`). All other lines are numbered from
/// 1.
inline constexpr LineId kProbeLine = 0;

struct LineOpened {
  std::string peer;  ///< for display: address and port, or `monitor`
  LineKind kind = LineKind::kTcp;
  bool is_probe = false;  ///< opens kProbeLine, of which there is at most one
  Guard guard = Guard::kNormal;
};

/// The transport reports the settings of its serial port. A line of RFC 2217 knows its own.
struct LineSettings {
  LineId line = 0;
  SerialSettings settings;
  bool is_cooked = false;  ///< the client's terminal echoes or edits lines
};

struct BytesIn {
  LineId line = 0;
  std::string_view bytes;
  /// Called between pieces of kMaxShownIn bytes, with the byte clock between commands; if true, the
  /// remaining bytes are not taken. May be empty.
  std::function<bool()> is_enough = {};
};

/// The transport has sent bytes of the line's outbox, which are removed. It needs no time and
/// concerns nothing else, so it also works on a frozen cell.
struct BytesOut {
  LineId line = 0;
  std::size_t count = 0;
};

/// No more bytes will arrive on the line: what it holds back for its client leaves now. Its outbox
/// is still sent.
struct InputEnded {
  LineId line = 0;
};

struct LineClosed {
  LineId line = 0;
  LineCloseReason reason = LineCloseReason::kClientClosed;
};

/// With the byte clock: no byte has come on the line for `settle_ms` of wall time.
struct LineSilent {
  LineId line = 0;
};

/// The physical controller's port is open. Precondition of this and the following inputs: the cell
/// has a device.
struct DeviceOpened {};

/// The physical controller's port has vanished or cannot be opened.
struct DeviceLost {
  std::string why;
};

/// The physical controller has sent bytes.
struct DeviceIn {
  std::string_view bytes;
};

/// Bytes of the device's outbox have been written, and are removed.
struct DeviceOut {
  std::size_t count = 0;
};

/// State and workcell of a cell.
struct MachineSnapshot {
  ModelPtr model;
  State state;
};
using MachineSnapshotPtr = std::shared_ptr<const MachineSnapshot>;

/// The cell is taken back to a state of its past, with the same robot and profile: see
/// Cell::is_in_past(). Precondition: it has no device.
struct Rewind {
  MachineSnapshotPtr past;
  ReplayTime from{};  ///< the time of that state, for the history
};

/// The recording of the cell's inputs has ended before the cell has. For the event; it changes
/// nothing.
struct RecordingFailed {
  std::string path;  ///< of its file
  std::string why;
};

using Input = std::variant<LineOpened, LineSettings, BytesIn, BytesOut, InputEnded, LineClosed,
                           LineSilent, DeviceOpened, DeviceLost, DeviceIn, DeviceOut, Rewind,
                           RecordingFailed, call::Call>;

/// The open line of an input; kProbeLine if it has none.
LineId line_of(const Input& input);
/// Whether it is an input of an open line.
bool is_of_line(const Input& input);
/// Whether it concerns only the line of the probe.
bool is_of_probe(const Input& input);

/// The result of an input: the number of the opened line, the number of bytes taken, or the outcome
/// of the call.
struct Applied {
  LineId line = 0;
  std::size_t bytes_taken = 0;
  call::Outcome outcome;
};

}  // namespace xr3
