// How much work a line causes, in a turn and in a time. Lines that cause little go first.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "core/sim_clock.hpp"

namespace xr3 {

class LineLoad {
 public:
  /// Half of the work of the time before is forgotten in this time.
  static constexpr WallNs kHalfLife = 16'000'000;

  /// A line whose turns before have cost up to `work_ns`.
  LineLoad(std::uint64_t work_ns, WallNs now) : peak_(work_ns), since_(now) {}

  /// A turn without work forgets nothing: the next one may find room for replies at last.
  void begin_turn() {
    if (of_turn_ == 0) return;
    peak_ = std::max(of_turn_, peak_ - peak_ / kForgotten - (peak_ % kForgotten != 0 ? 1 : 0));
    of_turn_ = 0;
  }

  void add(std::uint64_t work_ns) {
    of_turn_ += work_ns;
    of_time_ += work_ns;
  }

  /// The greatest of three figures in nanoseconds: the work of this turn; that of the turn before
  /// that cost most, of which each later one with work forgets a sixteenth, since the next may cost
  /// as much; and half of the work of the latest time, since a line may have many turns that cost
  /// nothing between those that cost much. Precondition: time does not go back.
  std::uint64_t at(WallNs now) {
    assert(now >= since_);
    const WallNs half_lives = (now - since_) / kHalfLife;
    of_time_ >>= std::min<WallNs>(half_lives, 63);
    since_ += half_lives * kHalfLife;
    return std::max({of_turn_, peak_, of_time_ / 2});
  }

 private:
  static constexpr std::uint64_t kForgotten = 16;

  std::uint64_t peak_;
  std::uint64_t of_turn_ = 0;
  std::uint64_t of_time_ = 0;
  WallNs since_;
};

}  // namespace xr3
