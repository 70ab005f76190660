// Wakes the lines of a frozen cell, whose replies leave late, and all of them when time passes
// again.
#pragma once

#include "cell/cell.hpp"
#include "server/lines/sessions.hpp"
#include "server/net/asio.hpp"

namespace xr3 {

class HoldTimer {
 public:
  /// The references must outlive it.
  HoldTimer(asio::io_context& io, const Cell& cell, LineSessions& lines)
      : cell_(cell), lines_(lines), timer_(io) {}

  /// Checks whether the cell is frozen. To be called after each input of the cell.
  void update();
  void close();

 private:
  void wait();
  void wake_lines();

  const Cell& cell_;
  LineSessions& lines_;
  asio::steady_timer timer_;
  bool was_frozen_ = false;
  bool is_waiting_ = false;
  bool is_closed_ = false;
};

}  // namespace xr3
