// The machine behind one handle: a shared model, a state, the events that have not been taken yet, and
// the camera's last picture. (files, commands with their ticks) -> state is a pure function.
#pragma once

#include <utility>

#include "core/camera_cache.hpp"
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

  /// What the camera sees now, made once for a state; null where the workcell has no camera.
  ImagePtr camera_image() {
    return model_->workcell().camera ? camera_.image(*model_, state_) : nullptr;
  }
  const CameraCache& camera() const { return camera_; }

  /// Moves time on; a tick in the past changes nothing.
  void advance_to(Tick tick) {
    if (tick > state_.tick && !is_at_rest()) camera_.touch();
    xr3::advance_to(*model_, state_, tick, events_);
  }
  /// Moves time on until nothing moves any more, but not past `limit`.
  void run_to_rest(Tick limit) {
    camera_.touch();
    xr3::run_to_rest(*model_, state_, limit, events_);
  }

  Reply execute(const Command& command) {
    if (!is_camera_inquiry(command)) camera_.touch();
    return xr3::execute(*model_, state_, command, events_, camera_);
  }
  /// Input line 1...8 from outside.
  void set_input(int line, bool high) { xr3::set_input(state_, line, high, events_); }

  /// The state as the files say, at tick 0.
  void reset() { restore(initial_state(*model_)); }
  /// Continues from a state that belongs to this model.
  void restore(State state) { edit() = std::move(state); }
  /// Continues from a state in its own workcell. The model's robot and profile are the same as before.
  void restore(ModelPtr model, State state) {
    model_ = std::move(model);
    restore(std::move(state));
  }
  /// The state, whose blocks may be changed from outside before the next call; see edit.hpp.
  State& edit() {
    camera_.touch();
    return state_;
  }
  /// Goes on in another workcell. The model's robot and profile are the same as before.
  void replace_workcell(ModelPtr model) {
    model_ = std::move(model);
    take_over_workcell(*model_, edit(), events_);
  }

  /// What has happened since the last call, in order.
  Events take_events() { return std::exchange(events_, {}); }
  const Events& events() const { return events_; }

 private:
  ModelPtr model_;
  State state_;
  Events events_;
  CameraCache camera_;  ///< no part of the state
};

}  // namespace xr3
