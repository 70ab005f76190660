// With the byte clock and `settle=MS`: tells the cell when no byte has come for that time on the
// line that it obeys, so that the robot runs to rest.
#pragma once

#include <functional>
#include <optional>

#include "cell/cell.hpp"
#include "server/lines/sessions.hpp"
#include "server/net/asio.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

class SilenceTimer {
 public:
  /// `acted` is called after the robot has run to rest.
  SilenceTimer(asio::io_context& io, Cell& cell, LineSessions& lines, std::function<void()> acted);

  /// Notes whether a byte has come. To be called after each input of the cell.
  void update();
  void close();

 private:
  /// How far the current line is.
  struct Progress {
    std::optional<LineId> line;
    std::uint64_t bytes_in = 0;
    bool operator==(const Progress&) const = default;
  };

  Progress progress() const;
  bool is_needed() const;
  bool is_moving() const;
  WallNs due() const;
  void wait();
  void look();

  Cell& cell_;
  LineSessions& lines_;
  std::function<void()> acted_;
  asio::steady_timer timer_;
  Progress last_;
  WallNs since_ = 0;  ///< wall time of the last progress
  bool is_waiting_ = false;
  bool is_closed_ = false;
};

}  // namespace xr3
