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

/// Sets or clears a bit. Returns whether it has changed.
bool set_bit(std::uint8_t& bits, int number, bool set) {
  if (has_bit(bits, number) == set) return false;
  bits = with_bit(bits, number, set);
  return true;
}

std::uint8_t mask_of(const Model& model, char label) {
  const int index = model.index_of(label);
  return index < 0 ? std::uint8_t{0} : model.motor(index).drive.microswitch.mask;
}

std::uint8_t input_bits(const Model& model, std::uint8_t inputs, char inquiry) {
  if (inquiry == 'K') return static_cast<std::uint8_t>(inputs & kLowInputs);
  if (inquiry != 'J') return 0;
  const InputMasks masks = input_masks_of_j(mask_of(model, 'A'), mask_of(model, 'B'));
  unsigned bits = 0;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    if (has_bit(inputs, kFirstInputOfJ + static_cast<int>(i))) bits |= masks[i];
  }
  return static_cast<std::uint8_t>(bits);
}

}  // namespace

bool is_asked_for(char label, char inquiry) {
  return inquiry == 'I' ? label >= 'C' : inquiry == 'J' && label < 'C';
}

InputMasks input_masks_of_j(std::uint8_t mask_of_a, std::uint8_t mask_of_b) {
  constexpr unsigned kReservedForSwitches = 3;  // in files of version 0.1
  unsigned taken = static_cast<unsigned>(mask_of_a) | mask_of_b;
  if ((taken & ~kReservedForSwitches) == 0) taken = kReservedForSwitches;
  InputMasks masks{};
  unsigned bit = 1;
  for (std::uint8_t& mask : masks) {
    while ((taken & bit) != 0) bit <<= 1U;
    mask = static_cast<std::uint8_t>(bit);
    bit <<= 1U;
  }
  return masks;
}

bool is_closed(const MotorModel& motor, Counts count) {
  if (motor.period != 0) {  // the closed range is finite: the profile is mark3
    const Counts beyond = (count - motor.closed.low) % motor.period;
    count = motor.closed.low + (beyond < 0 ? beyond + motor.period : beyond);
  }
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
  bits.inputs = input_bits(model, state.io.inputs, inquiry);
  for (int i = 0; i < model.motor_count(); ++i) {
    const std::uint8_t mask = model.motor(i).drive.microswitch.mask;
    if (!is_asked_for(model.motor(i).drive.label, inquiry)) continue;
    bits.fitted = static_cast<std::uint8_t>(bits.fitted | mask);
    if (reads_closed(model, state, i)) bits.closed = static_cast<std::uint8_t>(bits.closed | mask);
  }
  return bits;
}

}  // namespace xr3
