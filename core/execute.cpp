#include "core/execute.hpp"

#include <cassert>
#include <cstdlib>

#include "core/coupling.hpp"
#include "core/faults/camera_faults.hpp"
#include "core/faults/motor_faults.hpp"
#include "core/home.hpp"
#include "core/invariants.hpp"
#include "core/kinematics.hpp"
#include "core/motor.hpp"
#include "core/switches.hpp"

namespace xr3 {
namespace {

class Executor {
 public:
  Executor(const Model& model, State& state, Events& events, CameraCache& camera)
      : model_(model), state_(state), events_(events), camera_(camera) {}

  void operator()(const Move& move) {
    MotorState* motor = find(move.label);
    if (motor == nullptr) return;
    const bool wrapped = add_to_error(*motor, move.counts);
    emit(MoveTaken{move.label, move.counts, motor->error});
    if (wrapped)
      emit(Warning{WarningCode::kCounterOverflow, move.label, move.counts, motor->error, {}});
    counters_changed();
  }
  void operator()(const SetSpeed& speed) {
    if (MotorState* motor = find(speed.label)) {
      motor->speed = static_cast<std::uint8_t>(speed.counts_per_s);
    }
  }
  void operator()(const Stop& stop) {
    if (MotorState* motor = find(stop.label)) {
      set_error(*motor, 0);
      counters_changed();
    }
  }
  Reply operator()(const QueryError& query) {
    const MotorState* motor = find(query.label);
    return ErrorMagnitude{motor != nullptr ? std::abs(static_cast<int>(motor->error)) : 0};
  }
  Reply operator()(const QuerySignedError& query) {
    const MotorState* motor = find(query.label);
    return SignedError{motor != nullptr ? motor->error : std::int8_t{0}};
  }
  Reply operator()(const QuerySwitch& query) {
    if (find(query.label) == nullptr) return SwitchState{false};
    return SwitchState{reads_closed(model_, state_, model_.index_of(query.label))};
  }
  Reply operator()(const QuerySwitchesI&) { return switch_bits(model_, state_, 'I'); }
  Reply operator()(const QuerySwitchesJ&) { return switch_bits(model_, state_, 'J'); }
  Reply operator()(const QueryInputs&) { return switch_bits(model_, state_, 'K'); }

  void operator()(const SetAuxiliary& set) { set_auxiliary(state_, set.port, set.on, events_); }
  void operator()(const SetOutput& set) { set_output(state_, set.line, set.high, events_); }
  void operator()(const ControllerReset&) { reset_controller(model_, state_, events_); }

  void operator()(const ToggleDisplay&) { state_.display.on = !state_.display.on; }
  void operator()(const SetViewVector& view) { state_.display.view = {view.x, view.y, view.z}; }
  void operator()(const SoftHome&) { go_home(model_, state_, events_); }
  void operator()(const ToggleSimulator&) {
    state_.enabled = !state_.enabled;
    emit(EnabledChanged{state_.enabled});
  }
  void operator()(const SetRefreshPeriod& period) {
    state_.display.period_half_s = period.half_seconds;
  }
  void operator()(const ToggleErasing&) {
    state_.display.erase = !state_.display.erase;
    state_.tip_path = {};
    if (!state_.display.erase) {
      state_.tip_path.add(tool_tip(model_, positions(model_, state_.motors)));
    }
  }
  void operator()(const SelectStatus& select) { state_.display.status_option = select.option; }
  void operator()(const ToggleFunctionKeys&) {
    state_.display.function_keys = !state_.display.function_keys;
  }
  Reply operator()(const CameraImage&) {
    if (!uses_pixel(0, 0)) return NoReply{};
    return CameraRows{camera_.image(model_, state_)};
  }
  Reply operator()(const CameraRow& row) {
    if (!uses_pixel(0, row.row)) return NoReply{};
    return CameraRows{std::make_shared<const Image>(camera_.row(model_, state_, row.row))};
  }
  Reply operator()(const CameraPixel& pixel) {
    if (!uses_pixel(pixel.column, pixel.row)) return NoReply{};
    return PixelValue{camera_.pixel(model_, state_, pixel.column, pixel.row)};
  }

 private:
  MotorState* find(char label) {
    const int index = model_.index_of(label);
    if (index >= 0) return &state_.motor(index);
    return warn_of(label), nullptr;
  }
  void warn_of(char label) { emit(Warning{WarningCode::kNoSuchJoint, label, 0, 0, {}}); }

  void counters_changed() {
    update_blocked(model_, state_, positions(model_, state_.motors), events_);
  }

  // Whether the camera has this pixel. If not, emits a warning; if so, applies the effects of
  // faults of the camera.
  bool uses_pixel(int column, int row) {
    const auto& camera = model_.workcell().camera;
    const bool has =
        camera && column >= 0 && column < camera->pixels_x && row >= 0 && row < camera->pixels_y;
    if (!has) emit(Warning{WarningCode::kBadCameraArgument, 'A', 0, 0, {}});
    if (has) add_camera_effects(model_, state_, events_);
    return has;
  }

  void emit(EventBody body) { events_.push_back({state_.tick, std::move(body)}); }

  const Model& model_;
  State& state_;
  Events& events_;
  CameraCache& camera_;
};

}  // namespace

Reply execute(const Model& model, State& state, const Command& command, Events& events,
              CameraCache& camera) {
  Executor executor(model, state, events, camera);
  Reply reply = std::visit(
      [&]<class Each>(const Each& each) -> Reply {
        if constexpr (Inquiry<Each>) return executor(each);
        executor(each);
        return NoReply{};
      },
      command);
  assert(broken_invariant(model, state) == nullptr);
  return reply;
}

bool is_camera_inquiry(const Command& command) {
  return std::holds_alternative<CameraImage>(command) ||
         std::holds_alternative<CameraRow>(command) || std::holds_alternative<CameraPixel>(command);
}

}  // namespace xr3
