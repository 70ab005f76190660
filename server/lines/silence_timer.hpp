// With the byte clock and `settle=MS`: applies LineSilent to the cell when no byte has arrived for
// that time on the current line, so that the robot runs to rest.
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
  /// `on_input` is called after the robot has run to rest.
  SilenceTimer(asio::io_context& io, Cell& cell, LineSessions& lines,
               std::function<void()> on_input);

  /// Checks whether a byte has arrived. To be called after each input of the cell.
  void update();
  void close();

 private:
  /// The current line and the number of bytes that it has received.
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
  void check();

  Cell& cell_;
  LineSessions& lines_;
  std::function<void()> on_input_;
  asio::steady_timer timer_;
  Progress last_;
  WallNs since_ = 0;  ///< wall time of the last progress
  bool is_waiting_ = false;
  bool is_closed_ = false;
};

}  // namespace xr3
