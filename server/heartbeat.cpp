#include "server/heartbeat.hpp"

#include <chrono>

#include "server/wall_clock.hpp"

namespace xr3 {

void Heartbeat::acted() {
  const bool runs = cell_.clock().mode() == ClockMode::kReal && !cell_.is_at_rest();
  if (is_armed_ || !runs) return;
  is_armed_ = true;
  timer_.expires_after(std::chrono::seconds(1));
  timer_.async_wait([this](ErrorCode cancelled) {
    is_armed_ = false;
    if (!cancelled) beat();
  });
}

void Heartbeat::beat() {
  cell_.catch_up(wall_now());
  acted();
}

}  // namespace xr3
