// Sines and cosines that are bit-identical on every machine: plain double arithmetic on degrees, no
// libm, and tables indexed by encoder count. The build disables contraction into fused operations.
#pragma once

#include <vector>

#include "core/units.hpp"

namespace xr3 {

struct SinCos {
  double sin = 0;
  double cos = 1;
  bool operator==(const SinCos&) const = default;
};

/// Sine and cosine of an angle in degrees, |angle| < 1e9. The error is about one unit in the last
/// place; multiples of 90 are exact.
SinCos sin_cos_deg(double angle_deg);

/// Sine and cosine of home + direction * precision * position for every position in a range.
/// A range longer than kMaxTableBytes is not tabulated: each call computes the same bits.
class SinCosTable {
 public:
  static constexpr Counts kMaxTableBytes = 1 << 16;

  /// Tabulates angle_deg(position) = home_deg + step_deg * position.
  SinCosTable(double home_deg, double step_deg, Counts low, Counts high);

  SinCos at(Counts position) const {
    const auto index = static_cast<std::size_t>(position - low_);
    return index < table_.size() ? table_[index] : computed(position);
  }

 private:
  SinCos computed(Counts position) const;

  double home_deg_;
  double step_deg_;
  Counts low_;
  std::vector<SinCos> table_;
};

}  // namespace xr3
