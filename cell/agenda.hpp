// The moments at which bytes of the serial lines are due, in the order in which they act. Each line
// has at most one entry for each direction: that of the byte under way.
#pragma once

#include <cassert>
#include <compare>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "protocol/explain/wire_record.hpp"
#include "protocol/line/line_speed.hpp"

namespace xr3 {

/// A byte of a line in one direction that is due.
struct Due {
  Micros at = 0;
  LineId line = 0;
  Direction direction = Direction::kIn;
  auto operator<=>(const Due&) const = default;
};

class Agenda {
 public:
  bool empty() const { return dues_.empty(); }
  /// The earliest entry; of several at one moment that of the lowest line, input first.
  /// Precondition: not empty.
  const Due& first() const {
    assert(!empty());
    return *dues_.begin();
  }

  /// Replaces the entry of a line and direction; nullopt removes it.
  void set(LineId line, Direction direction, std::optional<Micros> at);
  /// Removes the entries of a line.
  void forget(LineId line) {
    for (const Direction each : {Direction::kIn, Direction::kOut}) set(line, each, std::nullopt);
  }

  bool operator==(const Agenda&) const = default;

 private:
  std::set<Due> dues_;
  std::map<std::pair<LineId, Direction>, Micros> moments_;  ///< of dues_
};

}  // namespace xr3
