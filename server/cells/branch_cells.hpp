// The cells of the call `branch`: each goes on from a time of another cell's past, with a robot
// port of its own, and closes some time after its last line and subscriber. A branch of a branch
// belongs to the same origin: the cell that is no branch.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
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

  /// Beyond this number an origin gets no further branch.
  static constexpr std::size_t kMostPerOrigin = 4;

  std::size_t size() const { return members_.size(); }
  /// The name of the origin of a cell, which may be a branch.
  const std::string& origin_of(const HostedCell& cell) const;
  /// The number of open branches of an origin.
  std::size_t count(const std::string& origin) const;
  /// The name of the next branch of an origin: `7-b1`, `7-b2`... Each is given once. A name of
  /// cells is at most 32 bytes, so a long origin is cut.
  std::string next_name(const std::string& origin);
  void add(CellPtr cell, std::string origin);
  /// An origin has closed, and its name may be given to another cell.
  void release_name(const HostedCell& origin) { named_.erase(origin.name()); }
  /// Closes no further cell, for the end of the process.
  void stop();

 private:
  struct KeptBranch {
    CellPtr cell;
    std::string origin;
    WallNs used = 0;  ///< when it last had a line or a subscriber
  };

  void arm();
  void close_unused();

  WallNs linger_;
  std::function<void(const CellPtr&)> close_;
  asio::steady_timer timer_;
  std::vector<KeptBranch> members_;
  std::map<std::string, std::uint64_t> named_;  ///< names given, by origin
  bool is_stopped_ = false;
};

}  // namespace xr3
