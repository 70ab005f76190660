// Everything that can change a cell, as values: lines that open and close, their bytes, and calls of
// the monitor. Sessions make them; Cell::apply is the one door through which they go in.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <variant>

#include "cell/serial_line.hpp"
#include "protocol/monitor/call.hpp"

namespace xr3 {

/// The server's own line, by which it asks whether lines are served (`RobotProbe`). Lines of programs are
/// numbered from 1.
inline constexpr LineId kProbeLine = 0;

struct LineOpened {
  std::string peer;  ///< for people: address and port, or what else it is
  LineKind kind = LineKind::kRaw;
  bool is_probe = false;  ///< it becomes kProbeLine; there is one at most
};

struct BytesIn {
  LineId line = 0;
  std::string_view bytes;
  /// Asked between pieces of kMaxShownIn bytes: true leaves the rest for another input. Empty: never.
  std::function<bool()> is_enough = {};
};

struct LineClosed {
  LineId line = 0;
  LineCloseReason reason = LineCloseReason::kClientClosed;
};

using Input = std::variant<LineOpened, BytesIn, LineClosed, call::Call>;

/// What came of an input: the number of a line that was opened, how many of the bytes were taken, or
/// the outcome of a call.
struct Applied {
  LineId line = 0;
  std::size_t bytes_taken = 0;
  call::Outcome outcome;
};

}  // namespace xr3
