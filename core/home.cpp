#include "core/home.hpp"

#include "core/carousel.hpp"
#include "core/coupling.hpp"
#include "core/grasp.hpp"
#include "core/kinematics.hpp"
#include "core/motor.hpp"
#include "core/stall.hpp"
#include "core/switches.hpp"

namespace xr3 {
namespace {

void stand_at_home(const Model& model, State& state) {
  for (int i = 0; i < model.motor_count(); ++i) {
    MotorState& motor = state.motor(i);
    set_error(motor, 0);
    motor.count = 0;
    motor.blocked = Blocked::kNo;
  }
  state.stall = Stall::kNo;
  state.jaws_warned = false;
  state.below_surface = is_below_surface(model, tool_tip(model, positions(model, state.motors)));
}

}  // namespace

State initial_state(const Model& model) {
  State state;
  state.blocks = model.workcell().blocks;
  for (int i = 0; i < model.motor_count(); ++i) {
    const MotorModel& motor = model.motor(i);
    state.motor(i).speed = static_cast<std::uint8_t>(motor.drive.speed_counts_per_s);
    state.motor(i).switch_closed = is_closed(motor, 0);
  }
  stand_at_home(model, state);
  find_riders(model, state);
  return state;
}

void reset_controller(const Model& model, State& state, Events& events) {
  for (int i = 0; i < model.motor_count(); ++i) {
    set_error(state.motor(i), 0);
    state.motor(i).speed = static_cast<std::uint8_t>(model.motor(i).drive.speed_counts_per_s);
  }
  for (int line = 1; line <= SetOutput::kLines; ++line) set_output(state, line, false, events);
  for (int port = 1; port <= SetAuxiliary::kPorts; ++port)
    set_auxiliary(state, port, false, events);
  update_blocked(model, state, positions(model, state.motors), events);
}

void go_home(const Model& model, State& state, Events& events) {
  if (state.held) release(model, state, positions(model, state.motors), events);
  stand_at_home(model, state);
  carry_riders(model, state);
  update_switches(model, state, events);
  events.push_back({state.tick, Homed{}});
}

}  // namespace xr3
