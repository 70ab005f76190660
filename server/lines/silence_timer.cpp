#include "server/lines/silence_timer.hpp"

#include <utility>

#include "cell/failure.hpp"

namespace xr3 {
namespace {

constexpr WallNs kNsPerMs = 1'000'000;

}  // namespace

SilenceTimer::SilenceTimer(asio::io_context& io, Cell& cell, LineSessions& lines,
                           std::function<void()> on_input)
    : cell_(cell), lines_(lines), on_input_(std::move(on_input)), timer_(io) {}

bool SilenceTimer::is_needed() const {
  const ByteClock* clock = cell_.byte_clock();
  return !is_closed_ && clock != nullptr && clock->settings().settle_ms;
}

SilenceTimer::Progress SilenceTimer::progress() const {
  const std::optional<LineId> line = current_line(cell_.value());
  return {line, line ? cell_.find_line(*line)->bytes_in() : 0};
}

void SilenceTimer::update() {
  if (!is_needed()) return;
  if (const Progress now = progress(); now != std::exchange(last_, now)) since_ = wall_now();
  if (!is_waiting_ && is_moving()) wait();
}

/// Whether silence would have an effect.
bool SilenceTimer::is_moving() const {
  return last_.line && cell_.clock().mode() == ClockMode::kBytes && !cell_.is_at_rest();
}

WallNs SilenceTimer::due() const {
  return since_ + cell_.byte_clock()->settings().settle_ms.value_or(0) * kNsPerMs;
}

void SilenceTimer::wait() {
  is_waiting_ = true;
  run_at(timer_, due(), [this] { fatal_if_throws("the byte clock", [this] { check(); }); });
}

// Executes the bytes that have arrived meanwhile first: a busy machine makes no silence.
void SilenceTimer::check() {
  lines_.run_turns();
  update();
  is_waiting_ = false;
  if (!is_needed() || !is_moving()) return;
  if (wall_now() < due()) return wait();
  cell_.apply(LineSilent{last_.line.value_or(0)}, wall_now());
  on_input_();
}

void SilenceTimer::close() {
  is_closed_ = true;
  timer_.cancel();
}

}  // namespace xr3
