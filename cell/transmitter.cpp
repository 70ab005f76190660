#include "cell/transmitter.hpp"

namespace xr3 {

void Transmitter::start(Micros now) {
  assert(!is_busy_);
  is_busy_ = true;
  start_ = now;
  characters_ = 0;
}

Micros Transmitter::due() const {
  assert(is_busy_);
  return start_ + time_.of(characters_ + 1);
}

void Transmitter::complete(bool has_more) {
  assert(is_busy_);
  ++characters_;
  is_busy_ = has_more;
}

void Transmitter::set_time(const CharacterTime& time) {
  if (time == time_) return;
  start_ += time_.of(characters_);
  characters_ = 0;
  time_ = time;
}

}  // namespace xr3
