#include "protocol/json/values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace xr3 {
namespace {

constexpr std::array<double, 10> kPowersOfTen = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
constexpr double kMaxExactInteger = 9007199254740992.0;  // 2^53: doubles above are integers

std::string_view name_of(ClockMode mode) {
  switch (mode) {
    case ClockMode::kReal: return "real";
    case ClockMode::kManual: return "manual";
    case ClockMode::kBytes: return "bytes";
  }
  return "";
}

}  // namespace

// An integer divided by a power of ten is the double nearest to that decimal number, so it is
// printed with exactly these digits. Adding 0 turns -0 into 0.
double rounded(double value, int decimals) {
  if (std::isnan(value)) return 0.0;
  const double most = std::numeric_limits<double>::max();
  const double finite = std::clamp(value, -most, most);
  const double scale = kPowersOfTen.at(static_cast<std::size_t>(decimals));
  if (std::abs(finite) >= kMaxExactInteger / scale) return finite;
  return std::round(finite * scale) / scale + 0.0;
}

Json clock_json(ClockMode mode, Rate rate) {
  return {{"mode", name_of(mode)}, {"rate", static_cast<double>(rate.millionths) / 1e6}};
}

Json point_json(const PointUm& point) {
  return {rounded(mm(point.x), kMmDecimals), rounded(mm(point.y), kMmDecimals),
          rounded(mm(point.z), kMmDecimals)};
}

}  // namespace xr3
