#include "core/execute.hpp"

#include <cassert>
#include <cstdlib>

#include "core/coupling.hpp"
#include "core/home.hpp"
#include "core/invariants.hpp"
#include "core/kinematics.hpp"
#include "core/motor.hpp"
#include "core/switches.hpp"

namespace xr3 {
namespace {

std::uint8_t with_bit(std::uint8_t bits, int number, bool set) {
  const unsigned mask = 1U << static_cast<unsigned>(number - 1);
  return static_cast<std::uint8_t>(set ? bits | mask : bits & ~mask);
}

bool has_bit(std::uint8_t bits, int number) {
  return (bits >> static_cast<unsigned>(number - 1) & 1U) != 0;
}

class Executor {
 public:
  Executor(const Model& model, State& state, Events& events, CameraCache& camera)
      : model_(model), state_(state), events_(events), camera_(camera) {}

  Reply operator()(const Move& move) {
    MotorState* motor = find(move.label);
    if (motor == nullptr) return NoReply{};
    const bool wrapped = add_to_error(*motor, move.counts);
    emit(MoveTaken{move.label, move.counts, motor->error});
    if (wrapped)
      emit(Warning{WarningCode::kCounterOverflow, move.label, move.counts, motor->error, {}});
    counters_changed();
    return NoReply{};
  }
  Reply operator()(const SetSpeed& speed) {
    if (MotorState* motor = find(speed.label)) {
      motor->speed = static_cast<std::uint8_t>(speed.counts_per_s);
    }
    return NoReply{};
  }
  Reply operator()(const Stop& stop) {
    if (MotorState* motor = find(stop.label)) {
      set_error(*motor, 0);
      counters_changed();
    }
    return NoReply{};
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
    const MotorState* motor = find(query.label);
    return SwitchState{motor != nullptr && motor->switch_closed};
  }
  Reply operator()(const QuerySwitchesI&) { return switch_bits(model_, state_, 'I'); }
  Reply operator()(const QuerySwitchesJ&) { return switch_bits(model_, state_, 'J'); }
  Reply operator()(const QueryInputs&) { return switch_bits(model_, state_, 'K'); }

  Reply operator()(const SetAuxiliary& set) {
    if (has_bit(state_.io.auxiliary, set.port) != set.on) emit(AuxiliaryChanged{set.port, set.on});
    state_.io.auxiliary = with_bit(state_.io.auxiliary, set.port, set.on);
    return NoReply{};
  }
  Reply operator()(const SetOutput& set) {
    if (has_bit(state_.io.outputs, set.line) != set.high) emit(OutputChanged{set.line, set.high});
    state_.io.outputs = with_bit(state_.io.outputs, set.line, set.high);
    return NoReply{};
  }
  Reply operator()(const ControllerReset&) {
    for (int i = 0; i < model_.motor_count(); ++i) {
      set_error(state_.motor(i), 0);
      state_.motor(i).speed = static_cast<std::uint8_t>(model_.motor(i).drive.speed_counts_per_s);
    }
    for (int line = 1; line <= 8; ++line) (*this)(SetOutput{line, false});
    for (int port = 1; port <= 2; ++port) (*this)(SetAuxiliary{port, false});
    counters_changed();
    return NoReply{};
  }

  Reply operator()(const ToggleDisplay&) {
    state_.display.on = !state_.display.on;
    return NoReply{};
  }
  Reply operator()(const SetViewVector& view) {
    state_.display.view = {view.x, view.y, view.z};
    return NoReply{};
  }
  Reply operator()(const SoftHome&) {
    go_home(model_, state_, events_);
    return NoReply{};
  }
  Reply operator()(const ToggleSimulator&) {
    state_.enabled = !state_.enabled;
    emit(EnabledChanged{state_.enabled});
    return NoReply{};
  }
  Reply operator()(const SetRefreshPeriod& period) {
    state_.display.period_half_s = period.half_seconds;
    return NoReply{};
  }
  Reply operator()(const ToggleErasing&) {
    state_.display.erase = !state_.display.erase;
    state_.tip_path = {};
    if (!state_.display.erase) {
      state_.tip_path.add(tool_tip(model_, positions(model_, state_.motors)));
    }
    return NoReply{};
  }
  Reply operator()(const SelectStatus& select) {
    state_.display.status_option = select.option;
    return NoReply{};
  }
  Reply operator()(const ToggleFunctionKeys&) {
    state_.display.function_keys = !state_.display.function_keys;
    return NoReply{};
  }
  Reply operator()(const CameraImage&) {
    if (!has_pixel(0, 0)) return NoReply{};
    return CameraRows{camera_.image(model_, state_)};
  }
  Reply operator()(const CameraRow& row) {
    if (!has_pixel(0, row.row)) return NoReply{};
    return CameraRows{std::make_shared<const Image>(camera_.row(model_, state_, row.row))};
  }
  Reply operator()(const CameraPixel& pixel) {
    if (!has_pixel(pixel.column, pixel.row)) return NoReply{};
    return PixelValue{camera_.pixel(model_, state_, pixel.column, pixel.row)};
  }

 private:
  MotorState* find(char label) {
    const int index = model_.index_of(label);
    if (index >= 0) return &state_.motor(index);
    emit(Warning{WarningCode::kNoSuchJoint, label, 0, 0, {}});
    return nullptr;
  }

  void counters_changed() {
    update_blocked(model_, state_, positions(model_, state_.motors), events_);
  }

  // Whether there is a camera with such a pixel. If not, emits a warning.
  bool has_pixel(int column, int row) {
    const auto& camera = model_.workcell().camera;
    const bool has =
        camera && column >= 0 && column < camera->pixels_x && row >= 0 && row < camera->pixels_y;
    if (!has) emit(Warning{WarningCode::kBadCameraArgument, 'A', 0, 0, {}});
    return has;
  }

  void emit(EventBody body) { events_.push_back({state_.tick, std::move(body)}); }

  const Model& model_;
  State& state_;
  Events& events_;
  CameraCache& camera_;
};

}  // namespace

void set_input(State& state, int line, bool high, Events& events) {
  assert(line >= 1 && line <= 8);
  if (has_bit(state.io.inputs, line) == high) return;
  state.io.inputs = with_bit(state.io.inputs, line, high);
  events.push_back({state.tick, InputChanged{line, high}});
}

Reply execute(const Model& model, State& state, const Command& command, Events& events,
              CameraCache& camera) {
  Reply reply = std::visit(Executor(model, state, events, camera), command);
  assert(broken_invariant(model, state) == nullptr);
  return reply;
}

bool is_camera_inquiry(const Command& command) {
  return std::holds_alternative<CameraImage>(command) ||
         std::holds_alternative<CameraRow>(command) || std::holds_alternative<CameraPixel>(command);
}

}  // namespace xr3
