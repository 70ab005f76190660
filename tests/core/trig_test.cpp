// Compares our sines and cosines with the C library's in long double.
#include "core/trig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace xr3 {
namespace {

constexpr long double kPiLong = 3.14159265358979323846264338327950288L;

// Exact reduction to 45 degrees first, so that the reference is accurate everywhere.
struct Reference {
  explicit Reference(double angle_deg) {
    int quarter = 0;
    const long double rest = std::remquo(static_cast<long double>(angle_deg), 90.0L, &quarter);
    const long double s = std::sin(rest * kPiLong / 180.0L);
    const long double c = std::cos(rest * kPiLong / 180.0L);
    const long double sines[] = {s, c, -s, -c};
    sin = sines[quarter & 3];
    cos = sines[(quarter + 1) & 3];
  }
  long double sin;
  long double cos;
};

double units_in_last_place(double got, long double wanted) {
  const auto near = static_cast<double>(std::fabs(wanted));
  const double unit = std::nextafter(near, 2.0) - near;
  return static_cast<double>(std::fabs(static_cast<long double>(got) - wanted)) / unit;
}

// The conversion to radians rounds twice, the series once more.
constexpr double kMaxUnits = 2.5;

void expect_near_reference(double angle_deg) {
  const SinCos got = sin_cos_deg(angle_deg);
  const Reference wanted(angle_deg);
  EXPECT_LE(units_in_last_place(got.sin, wanted.sin), kMaxUnits) << "sin " << angle_deg;
  EXPECT_LE(units_in_last_place(got.cos, wanted.cos), kMaxUnits) << "cos " << angle_deg;
}

TEST(Trig, IsExactAtMultiplesOf90) {
  constexpr SinCos kQuarter[] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};
  for (int quarter = -4000; quarter <= 4000; ++quarter) {
    EXPECT_EQ(sin_cos_deg(90.0 * quarter), kQuarter[quarter & 3]) << quarter << " quarters";
  }
}

TEST(Trig, HasDoublePrecisionBelowAThousandTurns) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-360'000.0, 360'000.0);
  for (int i = 0; i < 300'000; ++i) {
    const double deg = angle(random);
    expect_near_reference(deg);
  }
}

TEST(Trig, HasDoublePrecisionNearMultiplesOf45) {
  for (int eighth = -80; eighth <= 80; ++eighth) {
    for (const double offset : {1e-12, 1e-9, 1e-6, 1e-3, 0.1}) {
      for (const double deg : {45.0 * eighth - offset, 45.0 * eighth + offset}) {
        expect_near_reference(deg);
      }
    }
  }
}

TEST(Trig, ATableGivesTheSameBitsInsideAndOutsideItsRange) {
  const SinCosTable table(-90.0, 0.1135, -440, 881);
  for (Counts position = -2000; position <= 2000; ++position) {
    ASSERT_EQ(table.at(position), sin_cos_deg(-90.0 + 0.1135 * position)) << position;
  }
}

TEST(Trig, RangesTooLongForATableGiveTheSameBits) {
  const SinCosTable table(-90.0, 0.3125, -1'151'712, 1'152'288);
  for (const Counts position : {-1'151'712, -1'000'000, -288, 0, 288, 999'999, 1'152'288}) {
    EXPECT_EQ(table.at(position), sin_cos_deg(-90.0 + 0.3125 * position)) << position;
  }
  EXPECT_EQ(table.at(288), (SinCos{0, 1}));
}

}  // namespace
}  // namespace xr3
