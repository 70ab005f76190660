#include "protocol/line/line_speed.hpp"

#include <cassert>

namespace xr3 {
namespace {

__extension__ using WideMicros = __int128;

int half_bits_of(StopBits stop_bits) {
  switch (stop_bits) {
    case StopBits::kOne: return 2;
    case StopBits::kTwo: return 4;
    case StopBits::kOneAndAHalf: return 3;
  }
  return 2;
}

int half_bits_of(const SerialFrame& frame) {
  const int parity_bits = frame.parity == Parity::kNone ? 0 : 1;
  return 2 * (1 + frame.data_bits + parity_bits) + half_bits_of(frame.stop_bits);
}

}  // namespace

CharacterTime::CharacterTime(const SerialSettings& settings, Rate factor)
    : half_bits_(half_bits_of(settings.frame.value_or(SerialFrame{}))),
      baud_(settings.baud),
      factor_(factor) {
  assert(baud_ > 0 && factor_.millionths > 0);
}

// A rate of 10^6 millionths is the factor 1.
Micros CharacterTime::of(std::int64_t count) const { return half_micros_of(count) / 2; }

Micros CharacterTime::rounded() const { return (half_micros_of(1) + 1) / 2; }

/// The time of `count` characters in halves of a microsecond, rounded down.
std::int64_t CharacterTime::half_micros_of(std::int64_t count) const {
  constexpr WideMicros kMicrosPerSecond = 1'000'000;
  constexpr WideMicros kMillionths = 1'000'000;
  const WideMicros dividend = WideMicros{count} * half_bits_ * kMicrosPerSecond * kMillionths;
  return static_cast<std::int64_t>(dividend / (WideMicros{baud_} * factor_.millionths));
}

}  // namespace xr3
