// A machine with one serial line, without faults, in memory.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cell/apply.hpp"
#include "cell/receive.hpp"

namespace xr3::test {

struct OneLine {
  explicit OneLine(ModelPtr model, LineKind kind = LineKind::kTcp, Guard guard = Guard::kNormal)
      : cell{{Simulation(std::move(model)), SimClock::manual()}, {"one"}},
        line(cell.lines
                 .try_emplace(1, LineId{1}, cell.model().profile(), kind, "test", Tick{0}, guard)
                 .first->second) {}
  OneLine(const OneLine&) = delete;
  OneLine& operator=(const OneLine&) = delete;

  /// Returns the number of bytes taken. `out` has what comes of it, until the next call.
  std::size_t receive(std::string_view bytes) {
    cell.machine.take_events();
    out.hand_over();
    out.talk.clear();
    return bytes.empty() ? 0 : xr3::receive(cell, line, bytes, out);
  }
  void end_input() { apply(cell, InputEnded{1}, 0, {}, out); }
  /// Removes and returns the first `most` bytes of the outbox.
  std::string fetch(std::size_t most = std::string::npos) {
    std::string bytes(line.outbox().substr(0, most));
    line.sent(bytes.size(), 0);
    return bytes;
  }
  const std::vector<Exchange>& exchanges() const { return out.talk.exchanges; }

  CellState cell;
  SerialLine& line;
  CellOutput out{[](const CellOutput&) {}};
};

}  // namespace xr3::test
