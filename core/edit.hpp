// Changes of the workcell from outside, while the machine is running (monitor calls, not the paper's):
// blocks are put down, moved and taken away, or the whole workcell is another one.
#pragma once

#include <optional>
#include <string_view>

#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Index of the block with this name, if there is one.
std::optional<std::size_t> find_block(const State& state, std::string_view name);

bool is_held(const State& state, std::size_t block);

/// Takes away a block that is not held; the others keep their order.
void remove_block(State& state, std::size_t block);

/// The blocks are those of the model's workcell; what was held is gone. Motors go on as they were,
/// free of what stood between the jaws. The state belongs to a model with the same robot.
void take_over_workcell(const Model& model, State& state, Events& events);

}  // namespace xr3
