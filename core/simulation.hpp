// The simulated machine: a shared model, a state, the events since the last take_events(), and the
// cached camera image. (files, commands with their ticks) -> state is a pure function.
//
// The flow through core: the loaders of protocol/files fill a Robot and a Workcell (robot.hpp,
// workcell.hpp), from which Model (model.hpp) computes all integers and tables once. State
// (state.hpp) holds everything that changes. Time advances tick by tick (step.hpp): faults begin
// and end (faults/), motors make counts unless a limit or a block stops them (motor.hpp,
// coupling.hpp), the tip is computed and may stall the robot (kinematics.hpp, stall.hpp), then
// carousel, switches and jaws follow (carousel.hpp, switches.hpp, grasp.hpp, placement.hpp). Ticks
// without a count are skipped. Between ticks execute() (execute.hpp) runs a command of command.hpp
// and returns its reply, and calls of the monitor change inputs, faults, blocks or the workcell
// (workcell_edit.hpp). Each change appends an Event (event.hpp). Inquiries of the camera render an
// image (camera.hpp, camera/). drawing/ and inverse/ only read models and states, for pictures and
// planning. core prints nothing and reads no file, clock or thread: the caller supplies wall time
// to sim_clock.hpp.
#pragma once

#include <cassert>
#include <string>
#include <string_view>
#include <utility>

#include "core/camera/cache.hpp"
#include "core/command.hpp"
#include "core/event.hpp"
#include "core/execute.hpp"
#include "core/faults/effects.hpp"
#include "core/faults/faults.hpp"
#include "core/faults/line_faults.hpp"
#include "core/home.hpp"
#include "core/model.hpp"
#include "core/state.hpp"
#include "core/step.hpp"
#include "core/switches.hpp"
#include "core/workcell_edit.hpp"

namespace xr3 {

class Simulation {
 public:
  explicit Simulation(ModelPtr model) : model_(std::move(model)), state_(initial_state(*model_)) {}

  const Model& model() const { return *model_; }
  const ModelPtr& model_ptr() const { return model_; }
  const State& state() const { return state_; }
  Tick tick() const { return state_.tick; }
  bool is_at_rest() const { return xr3::is_at_rest(*model_, state_); }

  /// The camera image, rendered at most once per state; nullptr if the workcell has no camera.
  ImagePtr camera_image() {
    return model_->workcell().camera ? camera_.image(*model_, state_) : nullptr;
  }
  const CameraCache& camera() const { return camera_; }

  /// Advances time; a tick in the past has no effect.
  void advance_to(Tick tick) {
    if (xr3::advance_to(*model_, state_, tick, events_)) camera_.touch();
  }
  /// Advances time until nothing moves, but not beyond `limit`.
  void run_to_rest(Tick limit) {
    if (xr3::run_to_rest(*model_, state_, limit, events_)) camera_.touch();
  }

  Reply execute(const Command& command) {
    if (!is_camera_inquiry(command)) camera_.touch();
    return xr3::execute(*model_, state_, command, events_, camera_);
  }
  /// Sets input line 1...8.
  void set_input(int line, bool high) { xr3::set_input(state_, line, high, events_); }

  /// Restores the initial state of the model, at tick 0.
  void reset() { restore(initial_state(*model_)); }
  /// Continues from another state of this model.
  void restore(State state) {
    edit() = std::move(state);
    refresh_faults(*model_, state_);
  }
  /// Continues from a state with its own workcell. Precondition: same robot and profile.
  void restore(ModelPtr model, State state) {
    assert(is_same_machine(*model));
    model_ = std::move(model);
    restore(std::move(state));
  }
  /// The state, for changing its blocks before the next call; see workcell_edit.hpp.
  State& edit() {
    camera_.touch();
    return state_;
  }
  /// Replaces all faults; see faults.hpp for this and the next two.
  void install_faults(const FaultPlan& plan) {
    edit();
    xr3::install_faults(*model_, state_, plan, events_);
  }
  void set_fault(Fault fault) {
    edit();
    xr3::set_fault(*model_, state_, std::move(fault), events_);
  }
  bool clear_faults(std::string_view name) {
    edit();
    return xr3::clear_faults(*model_, state_, name, events_);
  }
  /// Applies the faults of a line to its bytes; see line_faults.hpp for this and the next two.
  Carried carry_input(const LinePlace& place, std::uint8_t byte) {
    return xr3::carry_input(*model_, state_, place, byte, events_);
  }
  Carried carry_reply(const LinePlace& place, std::string_view reply) {
    return xr3::carry_reply(*model_, state_, place, reply, events_);
  }
  std::string stray_bytes(const LinePlace& place) {
    return xr3::stray_bytes(*model_, state_, place, events_);
  }
  /// Continues in another workcell. Precondition: same robot and profile.
  void replace_workcell(ModelPtr model) {
    assert(is_same_machine(*model));
    model_ = std::move(model);
    take_over_workcell(*model_, edit(), events_);
  }

  /// Whether model and state are equal.
  bool operator==(const Simulation& other) const {
    return state_ == other.state_ && is_same_machine(*other.model_) &&
           model_->workcell() == other.model_->workcell();
  }

  /// Removes and returns the events since the last call, in order.
  Events take_events() { return std::exchange(events_, {}); }
  const Events& events() const { return events_; }

 private:
  /// Whether a model differs at most in its workcell.
  bool is_same_machine(const Model& model) const {
    return model.robot() == model_->robot() && model.profile() == model_->profile();
  }

  ModelPtr model_;
  State state_;
  Events events_;
  CameraCache camera_;  ///< not part of the state
};

}  // namespace xr3
