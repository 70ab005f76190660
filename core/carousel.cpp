#include "core/carousel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "core/workcell.hpp"

namespace xr3 {
namespace {

Micrometres center_x(const Model& model) { return model.carousel()->x_um; }
Micrometres center_y(const Model& model) { return model.carousel()->y_um; }

Counts count_of(const Model& model, const State& state) {
  return state.motor(model.carousel_index()).count;
}

bool touches(Micrometres bottom, Micrometres top) {
  return std::abs(bottom - top) <= kContactToleranceUm;
}

bool stands_on_carousel(const Model& model, const Block& block) {
  return is_over_carousel(model, block.centroid_um.x, block.centroid_um.y) &&
         touches(bottom_um(block), model.carousel()->top_um);
}

bool stands_on(const Block& block, const Block& lower) {
  return touches(bottom_um(block), top_um(lower)) && footprint_overlap_um(block, lower) > 0;
}

/// The blocks that stand on the carousel, then those that stand on them, and so on; sorted.
std::vector<std::uint32_t> blocks_on_carousel(const Model& model, const State& state) {
  std::vector<std::uint32_t> riding;
  std::vector<std::uint32_t> others;
  for (std::uint32_t i = 0; i < state.blocks.size(); ++i) {
    if (is_held(state, i)) continue;
    (stands_on_carousel(model, state.blocks[i]) ? riding : others).push_back(i);
  }
  for (std::size_t next = 0; next < riding.size(); ++next) {
    const Block& lower = state.blocks[riding[next]];
    const auto carried = [&](std::uint32_t i) { return stands_on(state.blocks[i], lower); };
    const auto left = std::stable_partition(others.begin(), others.end(),
                                            [&](std::uint32_t i) { return !carried(i); });
    riding.insert(riding.end(), left, others.end());
    others.erase(left, others.end());
  }
  std::sort(riding.begin(), riding.end());
  return riding;
}

/// The known entry of a block if it still describes its pose, else a new one.
Rider rider_of(const Model& model, const State& state, std::uint32_t block) {
  const auto known = std::find_if(state.riders.begin(), state.riders.end(),
                                  [block](const Rider& rider) { return rider.block == block; });
  if (known != state.riders.end() && as_turned(model, state, *known) == state.blocks[block])
    return *known;
  const Block& at = state.blocks[block];
  return {block, count_of(model, state), at.centroid_um, at.yaw_udeg};
}

}  // namespace

bool is_over_carousel(const Model& model, Micrometres x, Micrometres y) {
  if (!model.carousel()) return false;
  const Micrometres dx = x - center_x(model);
  const Micrometres dy = y - center_y(model);
  const Micrometres radius = model.carousel()->radius_um;
  return std::abs(dx) <= radius && std::abs(dy) <= radius && dx * dx + dy * dy <= radius * radius;
}

Micrometres surface_um(const Model& model, Micrometres x, Micrometres y) {
  const Micrometres surface = model.workcell().work_surface_um;
  return is_over_carousel(model, x, y) ? std::max(surface, model.carousel()->top_um) : surface;
}

Micrometres overhang_um(const Model& model, const Block& block) {
  if (!model.carousel()) return 0;
  const auto [sin, cos] = sin_cos_deg(degrees(block.yaw_udeg));
  const double dx = mm(center_x(model) - block.centroid_um.x);
  const double dy = mm(center_y(model) - block.centroid_um.y);
  const double along = std::max(std::abs(cos * dx + sin * dy) - mm(block.size_um.x) / 2, 0.0);
  const double across = std::max(std::abs(cos * dy - sin * dx) - mm(block.size_um.y) / 2, 0.0);
  return model.carousel()->radius_um - micrometres(std::sqrt(along * along + across * across));
}

Block as_turned(const Model& model, const State& state, const Rider& rider) {
  Block block = state.blocks[rider.block];
  const double turn = model.carousel()->step_deg * (count_of(model, state) - rider.count);
  const auto [sin, cos] = sin_cos_deg(turn);
  const double dx = mm(rider.centroid_um.x - center_x(model));
  const double dy = mm(rider.centroid_um.y - center_y(model));
  block.centroid_um = {center_x(model) + micrometres(cos * dx - sin * dy),
                       center_y(model) + micrometres(sin * dx + cos * dy), rider.centroid_um.z};
  block.yaw_udeg = normalized(rider.yaw_udeg + microdegrees(turn));
  return block;
}

void carry_riders(const Model& model, State& state) {
  for (const Rider& rider : state.riders)
    state.blocks.edit()[rider.block] = as_turned(model, state, rider);
}

void find_riders(const Model& model, State& state) {
  if (!model.carousel()) return;
  std::vector<Rider> riders;
  for (const std::uint32_t block : blocks_on_carousel(model, state))
    riders.push_back(rider_of(model, state, block));
  state.riders = std::move(riders);
}

}  // namespace xr3
