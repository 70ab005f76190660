#include "cell/serial_line.hpp"

#include <cassert>
#include <utility>

namespace xr3 {

std::size_t SerialLine::receive(std::string_view bytes, Simulation& simulation,
                                std::vector<Exchange>& exchanges) {
  released_.clear();
  const Effects effects{simulation, exchanges, micros_at(simulation.tick())};
  if (bytes.empty()) return 0;
  const bool was_paced = is_paced();
  const bool was_data = is_data(bytes.front());
  std::size_t taken = 0;
  while (taken < bytes.size() && accepts(bytes[taken]) && !is_not_a_robot_program_) {
    if (is_paced() != was_paced || (was_paced && is_data(bytes[taken]) != was_data)) break;
    const auto byte = static_cast<std::uint8_t>(bytes[taken++]);
    receive_byte(byte, bytes_in_++, effects);
  }
  return taken;
}

void SerialLine::receive_byte(std::uint8_t byte, std::uint64_t offset, const Effects& effects) {
  if (!is_network()) return take_data(byte, offset, effects);  // no detection, no telnet
  const Detection detection = guard_ == Guard::kOff ? Detection::kPass : detector_.feed(byte);
  is_not_a_robot_program_ = detection == Detection::kNotARobotProgram;
  if (detection != Detection::kPass) return;
  if (!detector_.held().empty()) {
    const std::string held = detector_.release();
    for (std::size_t i = 0; i < held.size(); ++i) {
      filter(static_cast<std::uint8_t>(held[i]), offset - held.size() + i, effects);
    }
  }
  filter(byte, offset, effects);
}

void SerialLine::filter(std::uint8_t byte, std::uint64_t offset, const Effects& effects) {
  const TelnetInput input = telnet_.feed(byte, outbox_);
  if (input.data) return take_data(*input.data, offset, effects);
  if (speed_) update_pace();
  if (input.control != BufferControl::kNone) control(input.control, effects.now);
}

void SerialLine::take_data(std::uint8_t byte, std::uint64_t offset, const Effects& effects) {
  if (!pace_) return act_on(byte, offset, effects);
  pace_->add_input({byte, offset}, effects.now);
}

/// Lets the listener, the device and the faults act on a byte before the controller does.
void SerialLine::act_on(std::uint8_t byte, std::uint64_t offset, const Effects& effects) {
  if (listener_ != nullptr) {
    listener_->byte_comes(id_, byte);
    if (is_cut()) return;
  }
  if (device_ != nullptr) {
    drop_unfinished();
    if (device_->is_engaged()) return act_on_device(byte, offset, effects);
  }
  const State& state = effects.simulation.state();
  if (faults_ && faults_->take_power_cycle(state)) endpoint_.reset();
  if (faults_ && !faults_->passes_input(state)) return act_on_faulty(byte, offset, effects);
  interpret(byte, offset, effects);
}

void SerialLine::interpret(std::uint8_t byte, std::uint64_t offset, const Effects& effects) {
  const std::vector<Parsed>& items =
      endpoint_.parse(byte, offset, effects.simulation.state().enabled);
  if (!items.empty()) execute(items, effects);  // most bytes complete nothing
}

void SerialLine::execute(const std::vector<Parsed>& items, const Effects& effects) {
  Simulation& simulation = effects.simulation;
  const bool was_enabled = simulation.state().enabled;
  std::string replies;
  for (const Parsed& item : items) {
    if (!announce(item)) return;
    endpoint_.execute(item, simulation, replies, effects.exchanges);
  }
  if (device_ != nullptr && was_enabled && !simulation.state().enabled) device_->engage(true);
  // A byte completes at most one inquiry, and that is the last exchange.
  if (!replies.empty()) answer(replies, effects.exchanges.back(), effects);
}

/// Returns whether the line still obeys: a fault may cut it in the time that passes.
bool SerialLine::announce(const Parsed& item) {
  const auto* command = std::get_if<Command>(&item.what);
  if (listener_ == nullptr || command == nullptr) return true;
  listener_->command_comes(id_, *command);
  return !is_cut();
}

void SerialLine::answer(std::string& replies, Exchange& exchange, const Effects& effects) {
  if (faults_ && !leaves_now(replies, exchange, effects)) return;
  if (pace_) return pace_->add_reply(replies, answer_of(exchange), effects.now);
  if (hold_.is_on()) return hold_.add(replies, answer_of(exchange));
  exchange.reply_from = output_end();
  send(replies);
  exchange.reply_to = output_end();
}

void SerialLine::control(BufferControl control, Micros now) {
  switch (control) {
    case BufferControl::kNone: break;
    case BufferControl::kSuspend:
      if (has_input_ended_) break;
      if (pace_) return pace_->halt(Direction::kOut, true, now);
      hold_.begin();
      break;
    case BufferControl::kResume: resume(now); break;
    case BufferControl::kDropReplies: drop_replies(now); break;
    case BufferControl::kDropInput: drop_input(); break;
    case BufferControl::kDropBoth:
      drop_replies(now);
      drop_input();
      break;
  }
}

void SerialLine::resume(Micros now) {
  if (pace_) return pace_->halt(Direction::kOut, false, now);
  release();
}

void SerialLine::drop_replies(Micros now) {
  hold_.discard();
  discard_held_back();
  if (!pace_) return;
  pace_->discard_replies();
  update_input_halt(now);
}

void SerialLine::drop_input() {
  if (pace_) pace_->discard_input();
}

void SerialLine::release() {
  const HeldReplies held = hold_.end();
  for (const wire::Item& item : held.items) {
    const std::uint64_t from = output_end();
    send(std::string_view(held.bytes).substr(item.from, item.to - item.from));
    released_.push_back({from, output_end(), item.what});
  }
}

void SerialLine::end_input(Micros now) {
  released_.clear();
  has_input_ended_ = true;
  resume(now);
}

void SerialLine::send(std::string_view replies) {
  telnet_.encode(replies, outbox_);
  if (listener_ != nullptr) listener_->reply_leaves(id_, replies);
}

void SerialLine::listen(LineListener& listener, LineId own) {
  assert(device_ == nullptr);
  listener_ = &listener;
  id_ = own;
}

LineKind SerialLine::kind() const {
  if (telnet_.has_com_port()) return LineKind::kRfc2217;
  return telnet_.is_telnet() ? LineKind::kTelnet : kind_;
}

void SerialLine::write_state(StateWriter& out) const {
  out.add(kind_, guard_, detector_, is_not_a_robot_program_, telnet_, endpoint_.parser(),
          device_parser_, seen_switches_, faults_, hold_, pace_, has_input_ended_, is_cooked_,
          settings_ ? text_of(*settings_) : "", bytes_in_, output_end());
}

// A large image is sent in many pieces. To keep the cost linear, the unsent bytes move to the front
// only when they are no more than the sent ones.
void SerialLine::sent(std::size_t count, Micros now) {
  assert(count <= outbox().size());
  sent_ += count;
  bytes_out_ += count;
  update_input_halt(now);
  if (sent_ < outbox_.size() - sent_) return;
  outbox_.erase(0, sent_);
  sent_ = 0;
}

}  // namespace xr3
