// The entries of a recording as values: each input of a cell with its time, what else the cell
// depends on, and what came of it, for comparison. Independent of JSON, files and the cell.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "protocol/explain/cell_event.hpp"
#include "protocol/line/line_guard.hpp"
#include "protocol/line/serial_settings.hpp"
#include "protocol/monitor/call.hpp"

namespace xr3 {

/// The transport reports the settings of its serial port. A line of RFC 2217 knows its own.
struct LineSettings {
  LineId line = 0;
  SerialSettings settings;
  bool is_cooked = false;  ///< the client's terminal echoes or edits lines
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

/// The physical controller's port is open.
struct DeviceOpened {};

/// The physical controller's port has vanished or cannot be opened.
struct DeviceLost {
  std::string why;
};

/// Bytes of the device's outbox have been written, and are removed.
struct DeviceOut {
  std::size_t count = 0;
};

}  // namespace xr3

namespace xr3::recording {

/// A line was opened, and got this number.
struct LineBegin {
  LineId line = 0;
  std::string peer;
  LineKind kind = LineKind::kTcp;
  Guard guard = Guard::kNormal;
};

/// Bytes of one read, as taken from the transport. Of the first read of a line all bytes are here,
/// since they are examined together; `taken` of them were taken.
struct LineInput {
  LineId line = 0;
  std::string bytes;
  std::size_t taken = 0;   ///< at most bytes.size()
  std::size_t unsent = 0;  ///< bytes of the outbox that the transport had not sent before
  std::string replies;     ///< bytes that the line has added to its outbox at once
};

/// The transport has sent bytes of the outbox: so many are left.
struct LineUnsent {
  LineId line = 0;
  std::size_t unsent = 0;
};

/// A call that was accepted.
struct CallMade {
  call::Call call;
};

/// The cell was taken back to this state, as by the call `seek`.
struct Rewound {
  SavedCellPtr saved;
};

struct DeviceInput {
  std::string bytes;
};
/// The device has not answered in time.
struct DeviceSilent {};

/// A line has added bytes to its outbox at this tick. For comparison.
struct Replies {
  LineId line = 0;
  std::string bytes;
};

/// The digest of the state at this tick. For comparison.
struct StateHash {
  std::string hash;
};

/// The recording ends here, by itself.
struct End {
  std::string hash;  ///< the digest of the state; empty if the cell went on
  std::string why;   ///< `stopped` or `limit`
};

using EntryBody = std::variant<LineBegin, LineSettings, LineInput, LineUnsent, InputEnded,
                               LineSilent, LineClosed, CallMade, Rewound, DeviceOpened, DeviceLost,
                               DeviceInput, DeviceOut, DeviceSilent, Replies, StateHash, End>;

struct Entry {
  Epoch epoch = 0;
  Tick tick = 0;
  int us = 0;  ///< with the byte clock: microseconds after the tick, 0...999
  EntryBody body;
};

}  // namespace xr3::recording
