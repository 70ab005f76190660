#include "server/lines/due_timer.hpp"

#include "cell/failure.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {

// With the manual clock, a call advances the cell, and with the byte clock, each input does.
void DueTimer::update() {
  const std::optional<Tick> due = next_wake(cell_.value());
  if (!due || is_closed_ || cell_.clock().mode() != ClockMode::kReal) return;
  const WallNs moment = cell_.clock().when(*due);
  if (waits_until_ && *waits_until_ <= moment) return;
  waits_until_ = moment;
  run_at(timer_, moment, [this] { fatal_if_throws("the serial lines", [this] { advance(); }); });
}

void DueTimer::advance() {
  waits_until_.reset();
  cell_.catch_up(wall_now());
  on_input_();
}

void DueTimer::close() {
  is_closed_ = true;
  timer_.cancel();
}

}  // namespace xr3
