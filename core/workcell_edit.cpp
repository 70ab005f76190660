#include "core/workcell_edit.hpp"

#include <algorithm>
#include <cassert>

#include "core/carousel.hpp"
#include "core/coupling.hpp"
#include "core/kinematics.hpp"
#include "core/motor.hpp"
#include "core/stall.hpp"

namespace xr3 {

std::optional<std::size_t> find_block(const State& state, std::string_view name) {
  const auto found = std::find_if(state.blocks.begin(), state.blocks.end(),
                                  [name](const Block& block) { return block.name == name; });
  if (found == state.blocks.end()) return std::nullopt;
  return static_cast<std::size_t>(found - state.blocks.begin());
}

void remove_block(const Model& model, State& state, std::size_t block) {
  assert(block < state.blocks.size() && !is_held(state, block));
  std::vector<Block>& blocks = state.blocks.edit();
  blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(block));
  if (state.held && state.held->block > block) --state.held->block;
  std::erase_if(state.riders, [block](const Rider& rider) { return rider.block == block; });
  for (Rider& rider : state.riders) rider.block -= rider.block > block ? 1 : 0;
  find_riders(model, state);
}

void take_over_workcell(const Model& model, State& state, Events& events) {
  state.blocks = model.workcell().blocks;
  state.held.reset();
  state.riders.clear();
  find_riders(model, state);
  state.jaws_warned = false;
  const Positions now = positions(model, state.motors);
  state.below_surface = is_below_surface(model, tool_tip(model, now));
  update_blocked(model, state, now, events);
}

}  // namespace xr3
