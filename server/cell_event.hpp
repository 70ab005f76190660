// What a cell tells the log and its monitors: the machine's events with the line that caused them,
// problems on the lines, and what happened to lines, clock and epoch.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "core/event.hpp"
#include "core/sim_clock.hpp"
#include "protocol/rhino_parser.hpp"
#include "server/input.hpp"

namespace xr3 {

/// Counts the states that are not a continuation of one another: reset, a loaded snapshot.
using Epoch = std::int64_t;

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
  std::string peer;
};
struct LineClosedNote {
  CloseReason reason;
  std::uint64_t bytes_in = 0;
  std::uint64_t bytes_out = 0;
};
struct ClockNote {
  std::string_view call;  ///< pause, resume or rate
};
struct EpochNote {
  Epoch from_epoch = 0;
  Tick from_tick = 0;
};

using CellNote = std::variant<EventBody, ProblemNote, SuppressedNote, LineOpenedNote,
                              LineClosedNote, ClockNote, EpochNote>;

struct CellEvent {
  Epoch epoch = 0;
  Tick tick = 0;
  std::optional<LineId> line;
  CellNote note;
};

using CellEventSink = std::function<void(const CellEvent&)>;

}  // namespace xr3
