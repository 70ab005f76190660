#include "core/switches.hpp"

namespace xr3 {
namespace {

constexpr unsigned kLowInputs = 0x0f;  // lines 1-4, answered by K in bits 0-3

// J carries input lines 5-8 in its bits 2-5.
std::uint8_t input_bits(std::uint8_t inputs, char inquiry) {
  if (inquiry == 'K') return static_cast<std::uint8_t>(inputs & kLowInputs);
  if (inquiry == 'J') return static_cast<std::uint8_t>((inputs >> 4) << 2);
  return 0;
}

}  // namespace

bool is_asked_for(char label, char inquiry) {
  return inquiry == 'I' ? label >= 'C' : inquiry == 'J' && label < 'C';
}

bool is_closed(const MotorModel& motor, Counts count) {
  return count >= motor.closed.low && count <= motor.closed.high;
}

void update_switches(const Model& model, State& state, Events& events) {
  for (int i = 0; i < model.motor_count(); ++i) {
    MotorState& motor = state.motor(i);
    const bool closed = is_closed(model.motor(i), motor.count);
    if (closed == motor.switch_closed) continue;
    motor.switch_closed = closed;
    events.push_back({state.tick, SwitchChanged{model.motor(i).drive.label, closed, motor.count}});
  }
}

SwitchBits switch_bits(const Model& model, const State& state, char inquiry) {
  SwitchBits bits;
  bits.inquiry = inquiry;
  bits.inputs = input_bits(state.io.inputs, inquiry);
  for (int i = 0; i < model.motor_count(); ++i) {
    const std::uint8_t mask = model.motor(i).drive.microswitch.mask;
    if (!is_asked_for(model.motor(i).drive.label, inquiry)) continue;
    bits.fitted = static_cast<std::uint8_t>(bits.fitted | mask);
    if (state.motor(i).switch_closed) bits.closed = static_cast<std::uint8_t>(bits.closed | mask);
  }
  return bits;
}

}  // namespace xr3
