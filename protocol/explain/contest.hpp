// Notices when two programs move one joint: a line moves a joint that still has counts to go from a
// recent move of another line. It only sees the events of a cell, so it changes neither the cell's
// state nor its digest.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <tuple>

#include "protocol/explain/cell_event.hpp"

namespace xr3 {

class ContestObserver {
 public:
  /// A move of another line counts for this time.
  static constexpr Tick kRecent = 2 * kTickHz;
  /// Maximum number of contests that are remembered; there are no notes of further ones until a
  /// line closes.
  static constexpr std::size_t kMaxContests = 256;

  /// Handles an event of the cell, in order. Returns the note that must follow it: once for two
  /// lines and a joint, until one of the lines closes.
  std::optional<ContestedNote> handle(const CellEvent& event);

  bool operator==(const ContestObserver&) const = default;

 private:
  struct LastMove {
    LineId line = 0;  ///< 0: none of an open line
    Tick tick = 0;
    bool operator==(const LastMove&) const = default;
  };
  static constexpr std::size_t kLabels = 8;  ///< A...H

  std::optional<ContestedNote> handle_move(LineId line, Tick tick, const MoveTaken& move);
  void forget(LineId line);

  std::array<LastMove, kLabels> last_moves_;
  std::set<std::tuple<LineId, LineId, char>> contests_;  ///< the line with the lower number first
};

}  // namespace xr3
