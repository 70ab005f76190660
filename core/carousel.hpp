// The carousel: a round table beside the arm that a motor turns about a vertical axis. Blocks that
// stand on it, or on a block that stands on it, turn with it. Not in the paper; an accessory of the
// Rhino.
#pragma once

#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Whether a place, seen from above, is within the carousel's radius; false without a carousel.
bool is_over_carousel(const Model& model, Micrometres x, Micrometres y);

/// z of the support of a block at this place: the top of the carousel within its radius, elsewhere
/// the work surface.
Micrometres surface_um(const Model& model, Micrometres x, Micrometres y);

/// The depth by which a block's footprint overlaps the carousel: the shortest horizontal distance
/// by which it would have to move. 0 or less if it does not overlap, or without a carousel.
Micrometres overhang_um(const Model& model, const Block& block);

/// The block of a rider at the carousel's count. Computed from the place where the block was put,
/// so that rounding errors do not add up.
Block as_turned(const Model& model, const State& state, const Rider& rider);

/// Moves the riders to their places at the carousel's count. Call after the count has changed.
void carry_riders(const Model& model, State& state);

/// Finds the blocks that ride on the carousel. Call after the pose, the number or the holding of
/// blocks has changed. A rider that has not been moved otherwise keeps its entry.
void find_riders(const Model& model, State& state);

}  // namespace xr3
