// The cells of the call `branch`: each goes on from a time of another cell's past, with a robot
// port of its own, and goes some time after its last line and subscriber.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "server/cells/hosted_cell.hpp"
#include "server/net/asio.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

class BranchCells {
 public:
  /// `close` removes a cell.
  BranchCells(asio::io_context& io, WallNs linger, std::function<void(const CellPtr&)> close)
      : linger_(linger), close_(std::move(close)), timer_(io) {}

  /// The name of the next branch: `b1`, `b2`... Each is given once.
  std::string next_name() { return "b" + std::to_string(++last_); }
  void add(CellPtr cell);
  /// Closes no further cell, for the end of the process.
  void stop();

 private:
  struct Member {
    CellPtr cell;
    WallNs used = 0;  ///< when it last had a line or a subscriber
  };

  void arm();
  void close_unused();

  WallNs linger_;
  std::function<void(const CellPtr&)> close_;
  asio::steady_timer timer_;
  std::vector<Member> members_;
  std::uint64_t last_ = 0;
  bool is_stopped_ = false;
};

}  // namespace xr3
