#include "server/net/loop_lag.hpp"

#include <algorithm>
#include <utility>

namespace xr3 {

void LoopLag::measure() {
  if (is_stopped_) return;
  is_measuring_ = true;
  const WallNs due = wall_now() + kInterval;
  run_at(timer_, due, [this, due] {
    is_measuring_ = false;
    const WallNs now = wall_now();
    record(now - due, now);
    if (is_busy_()) begin_measurement();
  });
}

void LoopLag::stop() {
  is_stopped_ = true;
  timer_.cancel();
}

void LoopLag::record(WallNs lag, WallNs now) {
  const WallNs window = now / kWindow;
  if (window != window_) {
    before_ = window == window_ + 1 ? max_ : 0;
    max_ = 0;
    window_ = window;
  }
  max_ = std::max(max_, lag);
}

WallNs LoopLag::max_at(WallNs now) const {
  const WallNs since = now / kWindow - window_;
  if (since == 0) return std::max(before_, max_);
  return since == 1 ? max_ : 0;
}

}  // namespace xr3
