// What hosted cells share in a server, for tests: turns, worker and registry.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "server/cells/registry.hpp"

namespace xr3::test {

struct CellHost {
  explicit CellHost(asio::io_context& loop)
      : io(loop), context{io,      turns,     worker, [this](HostedCell& at) { on_input(at); },
                          nullptr, &histories} {}

  /// Adds a cell with a manual clock.
  HostedCell& add(ModelPtr model, const std::string& name = "main", EventSink sink = {}) {
    CellPtr cell =
        HostedCell::make(context, {name, std::move(model), SimClock::manual(), std::move(sink)});
    cells.add(cell);
    return *cell;
  }

  asio::io_context& io;
  LineTurns turns{io};
  Worker worker;
  monitor::ByteBudget histories{1 << 20};
  std::function<void(HostedCell&)> on_input = [](HostedCell&) {};
  CellContext context;
  CellRegistry cells;
};

}  // namespace xr3::test
