// The events of a cell, for the log and the monitor port: the machine's events with the line that
// caused them, problems on the lines, and changes of lines, clock, model and epoch. Values only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/event.hpp"
#include "core/sim_clock.hpp"
#include "protocol/line/rhino_parser.hpp"

namespace xr3 {

/// Incremented whenever the state does not continue the previous one: by a reset or a loaded
/// snapshot.
using Epoch = std::int64_t;

/// Lines are numbered from 1 in the order of opening.
using LineId = std::uint32_t;

/// The transport of a line. A TCP connection becomes kTelnet or kRfc2217 when its client shows that
/// it speaks that protocol.
enum class LineKind : std::uint8_t {
  kTcp,      ///< plain bytes over TCP
  kTelnet,   ///< RFC 854
  kRfc2217,  ///< telnet with the settings of a serial port
  kPty,      ///< a pseudo-terminal
  kDevice,   ///< a serial device
  kMonitor,  ///< the monitor's call `send`
};

enum class LineCloseReason : std::uint8_t {
  kClientClosed,
  kNotARobotProgram,
  kError,
  kShutdown,
  kDisconnected,  ///< by the monitor's line_disconnect
  kMemory,        ///< the line held the most bytes when the memory was exhausted
  kFault,         ///< by a fault on demand; the last reason
};
inline constexpr std::size_t kLineCloseReasons =
    static_cast<std::size_t>(LineCloseReason::kFault) + 1;

/// Bytes that were not executed. `count` consecutive ones with the same code are one note.
struct ProblemNote {
  std::string_view code;
  std::string message;
  std::uint64_t offset = 0;
  RawBytes raw{};
  int count = 1;
  Tick first_tick = 0;  ///< tick of the first one; the note may be later, after the last one
  bool operator==(const ProblemNote&) const = default;
};
/// `count` warnings of a line were suppressed in this simulated second.
struct SuppressedNote {
  int count = 0;
};
struct LineOpenedNote {
  LineKind kind = LineKind::kTcp;
  std::string peer;
};
struct LineClosedNote {
  LineCloseReason reason;
  std::uint64_t bytes_in = 0;
  std::uint64_t bytes_out = 0;
};
/// With the byte clock: a line waits, unread, for another line, or its turn begins.
struct LineTurnNote {
  LineId waits_for = 0;  ///< 0 if its turn begins
};
/// The line has moved a joint that still has counts to go from a move of another one.
struct ContestedNote {
  LineId other = 0;
  char label = 0;
};
struct ClockNote {
  std::string_view call;  ///< pause, resume, rate, freeze or unfreeze
  ClockMode mode = ClockMode::kReal;
  Rate rate;
};
/// A call changed the workcell.
struct ModelNote {
  std::string_view call;  ///< block_add, block_move, block_remove, workcell, reset or snapshot_load
  std::string name;       ///< name of the block or the workcell
  int model_rev = 0;
};
struct EpochNote {
  std::string_view call;  ///< reset or snapshot_load
  Epoch from_epoch = 0;
  Tick from_tick = 0;
};

/// The running server has opened the cell.
struct CellOpenedNote {
  std::string cell;  ///< name of the cell
};
/// The running server closes the cell. No event of it follows.
struct CellClosedNote {
  std::string cell;
};

/// In a cell with a physical controller: the simulator was enabled or disabled. In a cell without
/// one this is EnabledChanged.
struct HandoverNote {
  bool enabled = true;
  std::string device;  ///< path of the device
  bool is_open = true;
  bool is_mirrored = false;
};

/// Changes of the physical controller behind the lines.
enum class DeviceNews : std::uint8_t {
  kOpened,
  kLost,
  kUnasked,
  kStopped,
  kMirrorDifference,
  kMirrorLost,
  kMirrorAligned,
};
struct DeviceNote {
  DeviceNews news = DeviceNews::kOpened;
  std::string path;
  std::string why;          ///< the reason, for kLost and kMirrorDifference
  RawBytes raw;             ///< kUnasked: the first bytes that no inquiry asked for
  std::uint64_t count = 0;  ///< kUnasked: the number of bytes
};

/// The call `notice`: a message for those who look at the cell.
struct NoticeNote {
  std::string text;
};

/// The recording of the cell has ended; the cell continues.
struct RecordingNote {
  std::string path;  ///< path of the recording's file
  std::string why;   ///< the reason; begins with the path
};

/// The server has been started again, and the cell goes on from the end of its recording; or it
/// cannot, and is fresh.
struct ContinuedNote {
  std::string path;  ///< path of the recording
  std::string why;   ///< the reason why it cannot; empty if it goes on
};

using CellNote = std::variant<EventBody, ProblemNote, SuppressedNote, LineOpenedNote,
                              LineClosedNote, LineTurnNote, ContestedNote, ClockNote, ModelNote,
                              EpochNote, HandoverNote, DeviceNote, CellOpenedNote, CellClosedNote,
                              NoticeNote, RecordingNote, ContinuedNote>;

struct CellEvent {
  Epoch epoch = 0;
  Tick tick = 0;
  std::optional<LineId> line;
  CellNote note;
};

}  // namespace xr3
