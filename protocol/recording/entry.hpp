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

namespace xr3::recording {

/// A line was opened, and got this number.
struct LineBegin {
  LineId line = 0;
  std::string peer;
  LineKind kind = LineKind::kTcp;
  Guard guard = Guard::kNormal;
};

/// A transport reported the settings of its serial port.
struct LineSetup {
  LineId line = 0;
  SerialSettings settings;
  bool is_cooked = false;
};

/// Bytes of one read, as taken from the transport. Of the first read of a line all bytes are here,
/// since they are examined together; `taken` of them were taken.
struct LineInput {
  LineId line = 0;
  std::string bytes;
  std::size_t taken = 0;   ///< at most bytes.size()
  std::size_t unsent = 0;  ///< bytes of the outbox that the transport had not sent before
  std::string replies;     ///< what the line has added to its outbox at once
};

/// The transport has sent bytes of the outbox: so many are left.
struct LineUnsent {
  LineId line = 0;
  std::size_t unsent = 0;
};

/// No more bytes arrive on the line.
struct LineInputEnd {
  LineId line = 0;
};

/// The line was silent for as long as the byte clock waits.
struct LineSilence {
  LineId line = 0;
};

struct LineEnd {
  LineId line = 0;
  LineCloseReason reason = LineCloseReason::kClientClosed;
};

/// A call that was accepted.
struct CallMade {
  call::Call call;
};

/// The cell was taken back to this state, as by the call `seek`.
struct Rewound {
  SavedCellPtr saved;
};

struct DeviceFound {};
struct DeviceGone {
  std::string why;
};
struct DeviceInput {
  std::string bytes;
};
/// So many bytes of the device's outbox have been written.
struct DeviceSent {
  std::size_t count = 0;
};
/// The device has not answered in time.
struct DeviceSilent {};

/// More bytes of paced lines were due than act in one advance of real time. Time went on to this
/// tick when `acts` bytes had acted since the start.
struct Late {
  std::uint64_t acts = 0;
  bool is_behind = false;  ///< bytes that are due have not acted yet
};

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

using Body = std::variant<LineBegin, LineSetup, LineInput, LineUnsent, LineInputEnd, LineSilence,
                          LineEnd, CallMade, Rewound, DeviceFound, DeviceGone, DeviceInput,
                          DeviceSent, DeviceSilent, Late, Replies, StateHash, End>;

struct Entry {
  Epoch epoch = 0;
  Tick tick = 0;
  int us = 0;  ///< of a clock that counts bytes: microseconds after the tick, 0...999
  Body body;
};

}  // namespace xr3::recording
