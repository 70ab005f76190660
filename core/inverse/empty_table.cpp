#include "core/inverse/empty_table.hpp"

#include <algorithm>
#include <cmath>

namespace xr3 {
namespace {

constexpr double kTableGridMm = 100;
constexpr double kTipHeightMm = 20;  ///< above the surface: about the centre of a block
constexpr double kHighestMm = 2000;
constexpr double kMostMm = 90'000;  ///< a workcell file has lengths of up to 100'000

double round_up(double number, double step) { return std::ceil(number / step) * step; }

/// A surface, and how far from the base axis the tip reaches over it, in mm.
struct Table {
  double surface;
  double furthest;
};

Table table_within(const Reach& reach) {
  for (double surface = 0; reach.is_quick() && surface < kHighestMm; surface += kTableGridMm / 2) {
    if (const auto furthest = reach.furthest_mm(surface + kTipHeightMm))
      return {surface, *furthest};
  }
  return {0, reach.most_mm()};
}

}  // namespace

Workcell empty_table(const Reach& reach) {
  const Table table = table_within(reach);
  const double x =
      round_up(std::clamp(table.furthest, kTableGridMm, kMostMm) + kTableGridMm, kTableGridMm);
  Workcell workcell;
  workcell.name = "empty table";
  workcell.workspace = {micrometres(x), micrometres(x - kTableGridMm),
                        micrometres(table.surface + x + kTableGridMm)};
  workcell.work_surface_um = micrometres(table.surface);
  return workcell;
}

}  // namespace xr3
