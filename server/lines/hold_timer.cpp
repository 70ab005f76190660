#include "server/lines/hold_timer.hpp"

#include <chrono>
#include <utility>

#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

// A held reply leaves at most so much later than it could.
constexpr std::chrono::milliseconds kEvery{250};

}  // namespace

void HoldTimer::update() {
  if (is_closed_) return;
  const bool is_over = std::exchange(was_frozen_, cell_.is_frozen()) && !was_frozen_;
  if (is_over) wake_lines();
  if (was_frozen_ && !is_waiting_) wait();
}

void HoldTimer::wait() {
  is_waiting_ = true;
  run_after(timer_, kEvery, [this] {
    is_waiting_ = false;
    wake_lines();
    update();
  });
}

void HoldTimer::wake_lines() {
  for (const auto& [id, line] : cell_.lines())
    if (!line.outbox().empty()) lines_.wake(id);
}

void HoldTimer::close() {
  is_closed_ = true;
  timer_.cancel();
}

}  // namespace xr3
