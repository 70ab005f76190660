// Units and small integer types of the machine: lengths in whole micrometres, angles in whole
// microdegrees, time in ticks. Decisions compare these integers; the state has no floating point.
#pragma once

#include <compare>
#include <cstdint>

namespace xr3 {

/// Simulated time in ticks of 1/kTickHz seconds. It never decreases within an epoch.
using Tick = std::int64_t;
inline constexpr int kTickHz = 1000;

/// Encoder counts of a motor, or counts of a joint position (motor counts plus coupling).
using Counts = std::int32_t;

/// Whole micrometres in the base frame.
using Micrometres = std::int64_t;

/// Whole microdegrees. A yaw is kept in (-180, 180] degrees.
using Microdegrees = std::int64_t;

inline constexpr double kMicrometresPerMm = 1000.0;
inline constexpr double kMicrodegreesPerDegree = 1e6;
inline constexpr double kPi = 3.14159265358979323846;

/// A point in the base frame, in micrometres.
struct PointUm {
  Micrometres x = 0;
  Micrometres y = 0;
  Micrometres z = 0;
  auto operator<=>(const PointUm&) const = default;
};

/// A point in mm, in the frame that its declaration names.
struct PointMm {
  double x = 0;
  double y = 0;
  double z = 0;
  bool operator==(const PointMm&) const = default;
};

/// The nearest whole micrometre (halves away from zero).
constexpr Micrometres micrometres(double mm) {
  const double um = mm * kMicrometresPerMm;
  return static_cast<Micrometres>(um < 0 ? um - 0.5 : um + 0.5);
}

/// The nearest whole microdegree (halves away from zero).
constexpr Microdegrees microdegrees(double degrees) {
  const double parts = degrees * kMicrodegreesPerDegree;
  return static_cast<Microdegrees>(parts < 0 ? parts - 0.5 : parts + 0.5);
}

/// The angle of this direction in (-180, 180] degrees.
constexpr Microdegrees normalized(Microdegrees angle) {
  constexpr Microdegrees kTurn = 360'000'000;
  angle %= kTurn;
  if (angle > kTurn / 2) angle -= kTurn;
  return angle <= -kTurn / 2 ? angle + kTurn : angle;
}

constexpr double mm(Micrometres um) { return static_cast<double>(um) / kMicrometresPerMm; }
constexpr double degrees(Microdegrees angle) {
  return static_cast<double>(angle) / kMicrodegreesPerDegree;
}

}  // namespace xr3
