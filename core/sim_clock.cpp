#include "core/sim_clock.hpp"

#include <cassert>

namespace xr3 {
namespace {

__extension__ using Wide = __int128;
// Length of a tick, in nanoseconds of wall time times millionths of rate.
constexpr Wide kNsMillionthsPerTick = Wide{1'000'000'000 / kTickHz} * 1'000'000;

}  // namespace

Tick SimClock::at(WallNs now) const {
  if (mode_ != ClockMode::kReal || now <= since_) return base_;
  return base_ + static_cast<Tick>(Wide{now - since_} * rate_.millionths / kNsMillionthsPerTick);
}

WallNs SimClock::when(Tick tick) const {
  assert(mode_ == ClockMode::kReal);
  if (tick <= base_) return since_;
  const Wide needed = Wide{tick - base_} * kNsMillionthsPerTick;
  return since_ + static_cast<WallNs>((needed + rate_.millionths - 1) / rate_.millionths);
}

void SimClock::pause(WallNs now) {
  base_ = at(now);
  mode_ = ClockMode::kManual;
}

void SimClock::resume(WallNs now) {
  base_ = at(now);
  since_ = now;
  mode_ = running_mode_;
}

void SimClock::set_rate(Rate rate, WallNs now) {
  assert(running_mode_ == ClockMode::kReal);
  set_tick(at(now), now);
  rate_ = rate;
}

void SimClock::set_tick(Tick tick, WallNs now) {
  base_ = tick;
  since_ = now;
}

}  // namespace xr3
