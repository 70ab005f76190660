// The machine behind one handle: a shared model, a state, and the events that have not been taken
// yet. (files, commands with their ticks) -> state is a pure function.
#pragma once

#include <utility>

#include "core/command.hpp"
#include "core/edit.hpp"
#include "core/event.hpp"
#include "core/execute.hpp"
#include "core/home.hpp"
#include "core/model.hpp"
#include "core/state.hpp"
#include "core/step.hpp"

namespace xr3 {

class Simulation {
 public:
  explicit Simulation(ModelPtr model) : model_(std::move(model)), state_(initial_state(*model_)) {}

  const Model& model() const { return *model_; }
  const ModelPtr& model_ptr() const { return model_; }
  const State& state() const { return state_; }
  Tick tick() const { return state_.tick; }
  bool is_at_rest() const { return xr3::is_at_rest(*model_, state_); }

  /// Moves time on; a tick in the past changes nothing.
  void advance_to(Tick tick) { xr3::advance_to(*model_, state_, tick, events_); }
  /// Moves time on until nothing moves any more, but not past `limit`.
  void run_to_rest(Tick limit) { xr3::run_to_rest(*model_, state_, limit, events_); }

  Reply execute(const Command& command) { return xr3::execute(*model_, state_, command, events_); }
  /// Input line 1...8 from outside.
  void set_input(int line, bool high) { xr3::set_input(state_, line, high, events_); }

  /// The state as the files say, at tick 0.
  void reset() { state_ = initial_state(*model_); }
  /// Continues from a state that belongs to this model.
  void restore(State state) { state_ = std::move(state); }
  /// Continues from a state in its own workcell. The model's robot and profile are the same as before.
  void restore(ModelPtr model, State state) {
    model_ = std::move(model);
    state_ = std::move(state);
  }
  /// The blocks of the state, to be changed from outside; see edit.hpp.
  State& edit() { return state_; }
  /// Goes on in another workcell. The model's robot and profile are the same as before.
  void replace_workcell(ModelPtr model) {
    model_ = std::move(model);
    take_over_workcell(*model_, state_, events_);
  }

  /// What has happened since the last call, in order.
  Events take_events() { return std::exchange(events_, {}); }
  const Events& events() const { return events_; }

 private:
  ModelPtr model_;
  State state_;
  Events events_;
};

}  // namespace xr3
