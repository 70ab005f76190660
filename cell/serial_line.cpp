#include "cell/serial_line.hpp"

#include <cassert>
#include <utility>

namespace xr3 {
namespace {

// A port of 7 data bits would make another character of it.
constexpr std::uint8_t kFirstByteOf8Bits = 0x80;

}  // namespace

std::size_t SerialLine::receive(std::string_view bytes, Simulation& simulation,
                                std::vector<Exchange>& exchanges) {
  released_.clear();
  std::size_t taken = 0;
  while (taken < bytes.size() && accepts(bytes[taken]) && !is_not_a_robot_program_) {
    const auto byte = static_cast<std::uint8_t>(bytes[taken++]);
    const std::uint64_t offset = bytes_in_++;
    if (!is_network()) {  // no detection, no telnet
      act_on(byte, offset, simulation, exchanges);
      continue;
    }
    const Detection detection = guard_ == Guard::kOff ? Detection::kPass : detector_.feed(byte);
    is_not_a_robot_program_ = detection == Detection::kNotARobotProgram;
    if (detection != Detection::kPass) continue;
    if (!detector_.held().empty()) {
      const std::string held = detector_.release();
      for (std::size_t i = 0; i < held.size(); ++i) {
        act(static_cast<std::uint8_t>(held[i]), offset - held.size() + i, simulation, exchanges);
      }
    }
    act(byte, offset, simulation, exchanges);
  }
  return taken;
}

void SerialLine::act(std::uint8_t byte, std::uint64_t offset, Simulation& simulation,
                     std::vector<Exchange>& exchanges) {
  const TelnetInput input = telnet_.feed(byte, outbox_);
  if (input.data) act_on(*input.data, offset, simulation, exchanges);
  if (input.replies != ReplyControl::kNone) control(input.replies);
}

void SerialLine::act_on(std::uint8_t byte, std::uint64_t offset, Simulation& simulation,
                        std::vector<Exchange>& exchanges) {
  if (device_ != nullptr) {
    drop_unfinished();
    if (device_->is_engaged()) return act_on_device(byte, offset, simulation, exchanges);
  }
  const bool was_enabled = simulation.state().enabled;
  std::string replies;
  endpoint_.feed(byte, offset, simulation, replies, exchanges);
  if (device_ != nullptr && was_enabled && !simulation.state().enabled) device_->engage(true);
  if (replies.empty()) return;
  // A byte completes at most one inquiry, and that is the last exchange.
  Exchange& exchange = exchanges.back();
  if (hold_.is_on()) return hold_.add(replies, answer_of(exchange));
  exchange.reply_from = output_end();
  send(replies);
  exchange.reply_to = output_end();
}

// Commands that were unfinished when the simulator was switched must not be completed afterwards.
void SerialLine::drop_unfinished() {
  if (std::exchange(seen_switches_, device_->switches()) == device_->switches()) return;
  endpoint_.reset();
  device_parser_ = RhinoParser(Profile::kMark3);
}

void SerialLine::act_on_device(std::uint8_t byte, std::uint64_t offset, Simulation& simulation,
                               std::vector<Exchange>& exchanges) {
  std::vector<Parsed> parsed;
  device_parser_.feed(byte, offset, parsed);
  for (Parsed& item : parsed) {
    Exchange& exchange = exchanges.emplace_back(Exchange{std::move(item), NoReply{}, {}, 0, 0});
    auto& what = exchange.parsed.what;
    const Command* command = std::get_if<Command>(&what);
    if (command != nullptr && std::holds_alternative<ToggleSimulator>(*command)) {
      simulation.execute(*command);
      exchange.events = simulation.take_events();
      device_->engage(false);
    } else if (command != nullptr && for_device(*command)) {
      exchange.is_for_device = true;
      device_->add(id_, *command, simulation.state().tick);
      if (device_->is_mirrored()) imitate(*command, exchange, simulation);
    } else if (command != nullptr && device_->is_mirrored()) {
      imitate(*command, exchange, simulation);
    } else if (command != nullptr || byte >= kFirstByteOf8Bits) {
      what = Problem{ProblemCode::kNotForDevice, Subject::kNone};
    }
  }
}

/// The reply is discarded: that of the device counts, and the commands that only the simulator has
/// are not answered by a physical controller.
void SerialLine::imitate(const Command& command, Exchange& exchange, Simulation& simulation) {
  simulation.execute(command);
  exchange.events = simulation.take_events();
}

void SerialLine::deliver(std::uint8_t reply, const Command& inquiry) {
  released_.clear();
  const std::string bytes(1, static_cast<char>(reply));
  const wire::FromDevice meaning{inquiry, reply};
  if (hold_.is_on()) return hold_.add(bytes, meaning);
  const std::uint64_t from = output_end();
  send(bytes);
  released_.push_back({from, output_end(), meaning});
}

void SerialLine::control(ReplyControl replies) {
  switch (replies) {
    case ReplyControl::kNone: break;
    case ReplyControl::kSuspend:
      if (!has_input_ended_) hold_.begin();
      break;
    case ReplyControl::kResume: release(); break;
    case ReplyControl::kDrop: hold_.discard(); break;
  }
}

void SerialLine::release() {
  const HeldReplies held = hold_.end();
  for (const wire::Item& item : held.items) {
    const std::uint64_t from = output_end();
    send(std::string_view(held.bytes).substr(item.from, item.to - item.from));
    released_.push_back({from, output_end(), item.what});
  }
}

void SerialLine::end_input() {
  released_.clear();
  has_input_ended_ = true;
  release();
}

void SerialLine::send(std::string_view replies) { telnet_.encode(replies, outbox_); }

LineKind SerialLine::kind() const {
  if (telnet_.has_com_port()) return LineKind::kRfc2217;
  return telnet_.is_telnet() ? LineKind::kTelnet : kind_;
}

// A large image is sent in many pieces. To keep the cost linear, the unsent bytes move to the front
// only when they are no more than the sent ones.
void SerialLine::sent(std::size_t count) {
  assert(count <= outbox().size());
  sent_ += count;
  bytes_out_ += count;
  if (sent_ < outbox_.size() - sent_) return;
  outbox_.erase(0, sent_);
  sent_ = 0;
}

}  // namespace xr3
