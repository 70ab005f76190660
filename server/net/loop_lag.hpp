// The delay of the event loop: the time from when a handler is due until it runs, which a client
// may have to wait for its turn. Measured as the delay of a timer, which is set only while there is
// work, so that an idle process does not wake up.
#pragma once

#include <functional>

#include "server/net/asio.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

class LoopLag {
 public:
  /// Time from the setting of the timer until it is due.
  static constexpr WallNs kInterval = 50'000'000;
  /// Length of a window; max_at() covers one to two of them.
  static constexpr WallNs kWindow = 30'000'000'000;

  /// `is_busy` is called after a measurement; if true, the next one begins at once.
  LoopLag(asio::io_context& io, std::function<bool()> is_busy)
      : timer_(io), is_busy_(std::move(is_busy)) {}

  /// Begins a measurement at new work, unless one is under way.
  void begin_measurement() {
    if (!is_measuring_) measure();
  }
  /// Ends all measurements; sets no further timer.
  void stop();

  /// The greatest delay, in nanoseconds, in the window of `now` and the one before.
  WallNs max_at(WallNs now) const;

 private:
  void measure();
  void record(WallNs lag, WallNs now);

  asio::steady_timer timer_;
  std::function<bool()> is_busy_;
  bool is_measuring_ = false;
  bool is_stopped_ = false;
  WallNs window_ = 0;  ///< number of the window of the last record
  WallNs max_ = 0;     ///< in that window
  WallNs before_ = 0;  ///< the maximum in the window before
};

}  // namespace xr3
