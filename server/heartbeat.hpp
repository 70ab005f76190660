// Keeps the log and the rings of a moving cell no more than a second behind. Armed only while time
// runs and something moves: at rest nothing wakes.
#pragma once

#include "server/asio.hpp"
#include "server/cell.hpp"

namespace xr3 {

class Heartbeat {
 public:
  Heartbeat(asio::io_context& io, Cell& cell) : timer_(io), cell_(cell) {}

  /// Something has acted on the cell: arms the timer where that is needed and not yet done.
  void acted();
  void stop() { timer_.cancel(); }

 private:
  void beat();

  asio::steady_timer timer_;
  Cell& cell_;
  bool is_armed_ = false;
};

}  // namespace xr3
