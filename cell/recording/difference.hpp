// The first point at which a replay differs from its recording.
#pragma once

#include <optional>
#include <string>

#include "protocol/explain/cell_event.hpp"

namespace xr3 {

struct Difference {
  Epoch epoch = 0;
  Tick tick = 0;
  std::optional<LineId> line;  ///< nullopt: it concerns no line
  std::string what;            ///< such as `reply`
  std::string expected;        ///< by the recording
  std::string found;           ///< in the replay
};

/// `epoch 0, tick 1200, line 1: reply: expected "!", found " "`.
std::string to_text(const Difference& difference);

}  // namespace xr3
