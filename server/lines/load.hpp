// How much work a line causes, in each turn and in a time. Lines that cause little go first.
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

  LineLoad(std::uint64_t work_ns, WallNs now) : of_turns_(work_ns), since_(now) {}

  /// Half of the work of the turns before is forgotten.
  void begin_turn() { of_turns_ /= 2; }

  void add(std::uint64_t work_ns) {
    of_turns_ += work_ns;
    of_time_ += work_ns;
  }

  /// The greater one of two sums in nanoseconds: of the latest turns, since the next one will cost
  /// about as much; and half of that of the latest time, since a line may have many turns that
  /// cost nothing between those that cost much. Precondition: time does not go back.
  std::uint64_t at(WallNs now) {
    assert(now >= since_);
    const WallNs half_lives = (now - since_) / kHalfLife;
    of_time_ >>= std::min<WallNs>(half_lives, 63);
    since_ += half_lives * kHalfLife;
    return std::max(of_turns_, of_time_ / 2);
  }

 private:
  std::uint64_t of_turns_;
  std::uint64_t of_time_ = 0;
  WallNs since_;
};

}  // namespace xr3
