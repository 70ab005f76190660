#include "core/derived.hpp"

#include "core/coupling.hpp"
#include "core/envelope.hpp"
#include "core/grasp.hpp"
#include "core/kinematics.hpp"
#include "core/motor.hpp"
#include "core/switches.hpp"

namespace xr3 {

State derived(const Model& model, State state) {
  Events unheard;
  const Positions now = positions(model, state.motors);
  for (int i = 0; i < model.motor_count(); ++i) set_error(state.motor(i), state.motor(i).error);
  update_switches(model, state, unheard);
  update_blocked(model, state, now, unheard);
  state.below_surface = is_below_surface(model, tool_tip(model, now));
  if (state.held) {
    state.blocks[state.held->block] =
        as_released(model, state, *state.held, state.held->grasped_at);
  }
  return state;
}

}  // namespace xr3
