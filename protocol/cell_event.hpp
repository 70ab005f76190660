// What a cell tells the log and its monitors: the machine's events with the line that caused them,
// problems on the lines, and what happened to lines, clock, model and epoch. Values only.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/event.hpp"
#include "core/sim_clock.hpp"
#include "protocol/rhino_parser.hpp"

namespace xr3 {

/// Counts the states that are not a continuation of one another: reset, a loaded snapshot.
using Epoch = std::int64_t;

/// Lines are numbered from 1 in the order in which they were opened.
using LineId = std::uint32_t;

/// What carries a line: a raw or telnet connection, or a monitor's `send`.
enum class LineKind : std::uint8_t { kRaw, kTelnet, kMonitor };

enum class CloseReason : std::uint8_t {
  kClientClosed,
  kStranger,
  kError,
  kShutdown,
  kDisconnected,  ///< by the monitor's line_disconnect
};

/// Bytes that were not obeyed; `count` of them in a run with the same code are one note.
struct ProblemNote {
  std::string_view code;
  std::string message;
  std::uint64_t offset = 0;
  RawBytes raw;
  int count = 1;
};
/// So many warnings of a line in this simulated second were left out.
struct SuppressedNote {
  int count = 0;
};
struct LineOpenedNote {
  LineKind kind = LineKind::kRaw;
  std::string peer;
};
struct LineClosedNote {
  CloseReason reason;
  std::uint64_t bytes_in = 0;
  std::uint64_t bytes_out = 0;
};
struct ClockNote {
  std::string_view call;  ///< pause, resume or rate
  ClockMode mode = ClockMode::kReal;
  Rate rate;
};
/// The workcell was changed by a call.
struct ModelNote {
  std::string_view call;  ///< block_add, block_move, block_remove, workcell, reset or snapshot_load
  std::string name;       ///< of the block or the workcell
  int model_rev = 0;
};
struct EpochNote {
  std::string_view call;  ///< reset or snapshot_load
  Epoch from_epoch = 0;
  Tick from_tick = 0;
};

using CellNote = std::variant<EventBody, ProblemNote, SuppressedNote, LineOpenedNote,
                              LineClosedNote, ClockNote, ModelNote, EpochNote>;

struct CellEvent {
  Epoch epoch = 0;
  Tick tick = 0;
  std::optional<LineId> line;
  CellNote note;
};

}  // namespace xr3
