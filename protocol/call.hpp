// The monitor's calls as values: what a client may do to a cell, and what comes of it. No JSON here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "core/sim_clock.hpp"
#include "core/units.hpp"

namespace xr3::call {

/// Time stands until resume (clock mode manual).
struct Pause {};
/// Time follows the wall clock again (clock mode real).
struct Resume {};
struct SetRate {
  Rate rate;  ///< kSlowest...kFastest
};
/// So many ticks in standing time, 0 and up.
struct Step {
  Tick ticks = 0;
};
/// Standing time runs until the cell is at rest, or until a tick, but for at most max_ticks.
struct RunUntil {
  std::optional<Tick> tick;  ///< none: until the cell is idle
  Tick max_ticks = 0;
};
/// The state as the files say; a new epoch begins at tick 0. Lines stay, their parsers are emptied.
struct Reset {};
/// The same as A$ on a line.
struct Home {};

using Call = std::variant<Pause, Resume, SetRate, Step, RunUntil, Reset, Home>;

/// A call that was carried out.
struct Done {
  std::optional<bool> reached;    ///< run_until only
  std::optional<Tick> ran_ticks;  ///< run_until only
};

/// A call that was refused; nothing was changed.
struct Refused {
  std::string code;  ///< stable, as in `clock_running`
  std::string message;
  std::string hint;
};

using Outcome = std::variant<Done, Refused>;

}  // namespace xr3::call
