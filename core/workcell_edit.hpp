// Edits of the workcell while the machine is running, for monitor calls (not in the paper): finding
// and removing blocks, and replacing the workcell.
#pragma once

#include <optional>
#include <string_view>

#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Index of the block with this name, or nullopt.
std::optional<std::size_t> find_block(const State& state, std::string_view name);

/// Removes a block. The others keep their order. Precondition: the block exists and is not held.
void remove_block(const Model& model, State& state, std::size_t block);

/// Replaces the blocks by those of the model's workcell; a held block disappears. Motors continue,
/// and a tool motor that was blocked by the held block is freed. The state must come from a model
/// with the same robot.
void take_over_workcell(const Model& model, State& state, Events& events);

}  // namespace xr3
