#include "core/derived_state.hpp"

#include <cassert>

#include "core/carousel.hpp"
#include "core/coupling.hpp"
#include "core/faults/effects.hpp"
#include "core/grasp.hpp"
#include "core/kinematics.hpp"
#include "core/motor.hpp"
#include "core/stall.hpp"
#include "core/switches.hpp"

namespace xr3 {

State derived(const Model& model, State state) {
  Events ignored;
  refresh_faults(model, state);
  const Positions now = positions(model, state.motors);
  for (int i = 0; i < model.motor_count(); ++i) {
    assert(model.motor(i).excess(now[static_cast<std::size_t>(i)]) == 0);
    set_error(state.motor(i), state.motor(i).error);
  }
  update_switches(model, state, ignored);
  update_blocked(model, state, now, ignored);
  state.below_surface = is_below_surface(model, tool_tip(model, now));
  if (state.held) {
    state.blocks.edit()[state.held->block] =
        as_released(model, state, *state.held, state.held->grasped_at);
  }
  if (model.carousel()) carry_riders(model, state);
  return state;
}

}  // namespace xr3
