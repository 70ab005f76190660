#include "core/placement.hpp"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <limits>

#include "core/carousel.hpp"
#include "core/workcell.hpp"

namespace xr3 {
namespace {

/// The support below a block, and the block that it overlaps.
struct Placement {
  Micrometres support_um = 0;         ///< z of the top of `support`
  const Block* support = nullptr;     ///< nullptr if it is the work surface or the carousel
  const Block* overlapped = nullptr;  ///< the first one in the list
  int overlaps = 0;
  bool is_in_carousel = false;  ///< whether the block overlaps the carousel
  char surface = 'A';           ///< the label of the carousel if the block is above it
};

/// A quick test that is true only for footprints that do not overlap.
bool are_clearly_apart(const Block& a, const Block& b) {
  const Micrometres reach = a.size_um.x + a.size_um.y + b.size_um.x + b.size_um.y;
  return 2 * std::abs(a.centroid_um.x - b.centroid_um.x) > reach ||
         2 * std::abs(a.centroid_um.y - b.centroid_um.y) > reach;
}

/// The overlap of two blocks in height; negative if one is above the other.
Micrometres height_overlap_um(const Block& a, const Block& b) {
  return std::min(top_um(a) - bottom_um(b), top_um(b) - bottom_um(a));
}

void add(Placement& placement, const Block& block, const Block& other) {
  if (are_clearly_apart(block, other)) return;
  const Micrometres overlap = footprint_overlap_um(block, other);
  if (overlap <= 0) return;
  const Micrometres top = top_um(other);
  const bool is_below = top <= bottom_um(block) + kContactToleranceUm;
  if (is_below && top > placement.support_um) {
    placement.support_um = top;
    placement.support = &other;
  }
  if (std::min(overlap, height_overlap_um(block, other)) <= kContactToleranceUm) return;
  if (placement.overlapped == nullptr) placement.overlapped = &other;
  ++placement.overlaps;
}

char carousel_label(const Model& model) { return model.motor(model.carousel_index()).drive.label; }

bool is_in_carousel(const Model& model, const Block& block) {
  if (!model.carousel()) return false;
  const Micrometres depth = model.carousel()->top_um - bottom_um(block);
  return std::min(overhang_um(model, block), depth) > kContactToleranceUm;
}

Placement placement_of(const Model& model, const State& state, std::size_t block) {
  assert(block < state.blocks.size() && !(state.held && state.held->block == block));
  Placement placement;
  const Block& placed = state.blocks[block];
  const PointUm& at = placed.centroid_um;
  placement.support_um = surface_um(model, at.x, at.y);
  if (is_over_carousel(model, at.x, at.y)) placement.surface = carousel_label(model);
  placement.is_in_carousel = is_in_carousel(model, placed);
  for (std::size_t i = 0; i < state.blocks.size(); ++i) {
    const bool is_held = state.held && state.held->block == i;
    if (i != block && !is_held) add(placement, placed, state.blocks[i]);
  }
  return placement;
}

bool overlaps_anything(const Placement& placement) {
  return placement.overlaps > 0 || placement.is_in_carousel;
}

/// A warning that names an overlapped block first; `label` is that of the carousel if the block
/// overlaps nothing else.
Warning overlap_warning(const Model& model, const Block& block, const Placement& placement) {
  if (placement.overlaps == 0)
    return {WarningCode::kBlocksOverlap, carousel_label(model), 0, 0, block.name};
  return {WarningCode::kBlocksOverlap, 'A', placement.overlaps, 0, block.name,
          placement.overlapped->name};
}

Warning air_warning(const Block& block, const Placement& placement, Micrometres gap_um) {
  assert(gap_um <= std::numeric_limits<int>::max());  // no link is longer than 100 m
  return {WarningCode::kReleasedInAir,
          placement.support == nullptr ? placement.surface : 'A',
          static_cast<int>(gap_um),
          0,
          block.name,
          placement.support == nullptr ? "" : placement.support->name};
}

}  // namespace

Micrometres height_above_support_um(const Model& model, const State& state, std::size_t block) {
  return bottom_um(state.blocks[block]) - placement_of(model, state, block).support_um;
}

void warn_of_overlap(const Model& model, const State& state, std::size_t block, Events& events) {
  const Placement placement = placement_of(model, state, block);
  if (!overlaps_anything(placement)) return;
  events.push_back({state.tick, overlap_warning(model, state.blocks[block], placement)});
}

void warn_of_placement(const Model& model, const State& state, std::size_t block, Events& events) {
  const Block& placed = state.blocks[block];
  const Placement placement = placement_of(model, state, block);
  const Micrometres gap_um = bottom_um(placed) - placement.support_um;
  if (overlaps_anything(placement)) {
    events.push_back({state.tick, overlap_warning(model, placed, placement)});
  } else if (gap_um > kContactToleranceUm) {
    events.push_back({state.tick, air_warning(placed, placement, gap_um)});
  }
}

}  // namespace xr3
