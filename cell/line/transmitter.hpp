// The clock of one direction of a serial line: it tells when the character under way is complete.
// Characters that follow each other without a pause share the rounding of their times, so a long
// run does not drift.
#pragma once

#include <cassert>
#include <cstdint>

#include "protocol/line/line_speed.hpp"
#include "protocol/line/state_writer.hpp"

namespace xr3 {

class Transmitter {
 public:
  explicit Transmitter(const CharacterTime& time) : time_(time) {}

  bool is_busy() const { return is_busy_; }
  /// Begins the first character of a run. Precondition: not busy.
  void start(Micros now) {
    assert(!is_busy_);
    is_busy_ = true;
    start_ = now;
    characters_ = 0;
  }
  /// When the character under way is complete. Precondition: busy.
  Micros due() const {
    assert(is_busy_);
    return start_ + time_.of(characters_ + 1);
  }
  /// The character under way is complete; the next one follows at once if there are more.
  /// Precondition: busy.
  void complete(bool has_more) {
    assert(is_busy_);
    ++characters_;
    is_busy_ = has_more;
  }
  /// The character under way starts again with the next start(). No effect if not busy.
  void stop() { is_busy_ = false; }

  /// Characters take this time from the one under way on.
  void set_time(const CharacterTime& time) {
    if (time == time_) return;
    start_ += time_.of(characters_);
    characters_ = 0;
    time_ = time;
  }

  /// The time of characters follows from the settings of the line.
  void write_state(StateWriter& out) const {
    out.add(is_busy_);
    if (is_busy_) out.add(start_, characters_);
  }

  bool operator==(const Transmitter&) const = default;

 private:
  CharacterTime time_;
  bool is_busy_ = false;
  Micros start_ = 0;             ///< of the run
  std::int64_t characters_ = 0;  ///< of the run that are complete
};

}  // namespace xr3
