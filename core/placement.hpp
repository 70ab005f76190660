// The position of a placed block among the others: its support, and the blocks that it
// overlaps. The machine has no gravity and no collisions (paper, Section III-B), so a block that
// was released too high or into another one shows only later, when a program fails to grasp it.
#pragma once

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// The height of the underside of the block above its support: another block, the carousel or the
/// work surface. Precondition: the block exists and is not held.
Micrometres height_above_support_um(const Model& model, const State& state, std::size_t block);

/// Warns if the block overlaps others, or the carousel (`blocks_overlap`), by more than the
/// tolerance, horizontally and vertically. A held block is not considered. Precondition: the block
/// exists and is not held.
void warn_of_overlap(const Model& model, const State& state, std::size_t block, Events& events);

/// Warns like warn_of_overlap(); if the block overlaps nothing, warns if its underside is further
/// above the work surface, the carousel, or the highest block below it, than the tolerance
/// (`released_in_air`). Precondition: the block exists and is not held.
void warn_of_placement(const Model& model, const State& state, std::size_t block, Events& events);

}  // namespace xr3
