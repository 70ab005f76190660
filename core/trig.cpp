#include "core/trig.hpp"

#include <array>
#include <cmath>

namespace xr3 {
namespace {

constexpr int kTerms = 18;

// 1 / (n (n + 1)): the ratio of successive terms of either series, without the factor -x^2.
constexpr std::array<double, kTerms> kShrink = [] {
  std::array<double, kTerms> shrink{};
  for (int n = 1; n < kTerms; ++n) shrink[static_cast<std::size_t>(n)] = 1.0 / (n * (n + 1));
  return shrink;
}();

// Taylor series by Horner's rule. Requires |x| <= pi/4; the first omitted term is then below 1e-17.
double series(double x2, int first, int last) {
  double sum = 1.0;
  for (int n = last; n >= first; n -= 2)
    sum = 1.0 - sum * (x2 * kShrink[static_cast<std::size_t>(n)]);
  return sum;
}

double sine_near_zero(double x) { return x * series(x * x, 2, 16); }

double cosine_near_zero(double x) { return series(x * x, 1, 17); }

}  // namespace

SinCos sin_cos_deg(double angle_deg) {
  const double quarters = std::floor(angle_deg / 90.0 + 0.5);  // exact on every machine
  const double rest = (angle_deg - 90.0 * quarters) * (kPi / 180.0);
  const double s = sine_near_zero(rest);
  const double c = cosine_near_zero(rest);
  switch (static_cast<long long>(quarters) & 3) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

SinCosTable::SinCosTable(double home_deg, double step_deg, Counts low, Counts high)
    : home_deg_(home_deg), step_deg_(step_deg), low_(low) {
  if (high - low >= kMaxTableBytes) return;
  const Counts positions = high - low + 1;
  table_.reserve(static_cast<std::size_t>(positions));
  for (Counts position = low; position <= high; ++position) table_.push_back(computed(position));
}

SinCos SinCosTable::computed(Counts position) const {
  return sin_cos_deg(home_deg_ + step_deg_ * static_cast<double>(position));
}

}  // namespace xr3
