#include "core/switches.hpp"

#include <cassert>

#include "core/faults/motor_faults.hpp"

namespace xr3 {
namespace {

constexpr unsigned kLowInputs = 0x0f;  // lines 1-4, answered by K in bits 0-3

std::uint8_t with_bit(std::uint8_t bits, int number, bool set) {
  const unsigned mask = 1U << static_cast<unsigned>(number - 1);
  return static_cast<std::uint8_t>(set ? bits | mask : bits & ~mask);
}

bool has_bit(std::uint8_t bits, int number) {
  return (bits >> static_cast<unsigned>(number - 1) & 1U) != 0;
}

/// Returns whether it has changed.
bool set_bit(std::uint8_t& bits, int number, bool set) {
  if (has_bit(bits, number) == set) return false;
  bits = with_bit(bits, number, set);
  return true;
}

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

void update_switches(const Model& model, State& state, Events& events, MotorBits motors) {
  for (int i = 0; i < model.motor_count(); ++i) {
    if (!has_motor(motors, i)) continue;
    MotorState& motor = state.motor(i);
    const bool closed = with_stuck_switch(state, i, is_closed(model.motor(i), motor.count));
    if (closed == motor.switch_closed) continue;
    motor.switch_closed = closed;
    events.push_back({state.tick, SwitchChanged{model.motor(i).drive.label, closed, motor.count}});
    begin_bounce(model, state, i, events);
  }
}

void set_output(State& state, int line, bool high, Events& events) {
  assert(line >= 1 && line <= SetOutput::kLines);
  if (set_bit(state.io.outputs, line, high))
    events.push_back({state.tick, OutputChanged{line, high}});
}

void set_auxiliary(State& state, int port, bool on, Events& events) {
  assert(port >= 1 && port <= SetAuxiliary::kPorts);
  if (set_bit(state.io.auxiliary, port, on))
    events.push_back({state.tick, AuxiliaryChanged{port, on}});
}

void set_input(State& state, int line, bool high, Events& events) {
  assert(line >= 1 && line <= SetOutput::kLines);
  if (set_bit(state.io.inputs, line, high))
    events.push_back({state.tick, InputChanged{line, high}});
}

SwitchBits switch_bits(const Model& model, const State& state, char inquiry) {
  SwitchBits bits;
  bits.inquiry = inquiry;
  bits.inputs = input_bits(state.io.inputs, inquiry);
  for (int i = 0; i < model.motor_count(); ++i) {
    const std::uint8_t mask = model.motor(i).drive.microswitch.mask;
    if (!is_asked_for(model.motor(i).drive.label, inquiry)) continue;
    bits.fitted = static_cast<std::uint8_t>(bits.fitted | mask);
    if (reads_closed(model, state, i)) bits.closed = static_cast<std::uint8_t>(bits.closed | mask);
  }
  return bits;
}

}  // namespace xr3
