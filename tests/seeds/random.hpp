// The only source of chance of a run: the same seed gives the same decisions on every machine.
// (SplitMix64; the distributions of the standard library differ between implementations.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace xr3::seeds {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) { next(); }

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  /// 0...count-1; 0 if `count` is 0.
  std::size_t below(std::size_t count) { return count == 0 ? 0 : next() % count; }
  /// least...most
  std::size_t between(std::size_t least, std::size_t most) {
    return least + below(most - least + 1);
  }
  /// True with this probability, in thousandths.
  bool chance(std::size_t thousandths) { return below(1000) < thousandths; }
  /// About equally many numbers of each length in bits, from 1 up to `most`.
  std::size_t spread(std::size_t most) {
    std::size_t limit = 1;
    while (limit < most && chance(750)) limit *= 2;
    return between(1, limit < most ? limit : most);
  }
  template <class Value>
  Value any_of(std::initializer_list<Value> values) {
    return values.begin()[below(values.size())];
  }

 private:
  std::uint64_t state_;
};

}  // namespace xr3::seeds
