// The part of a serial line that concerns the physical controller.
#include <cassert>
#include <utility>

#include "cell/serial_line.hpp"

namespace xr3 {
namespace {

// A port of 7 data bits would make another character of it.
constexpr std::uint8_t kFirstByteOf8Bits = 0x80;

}  // namespace

void SerialLine::connect(DeviceLink& link, LineId own) {
  assert(!speed_);
  device_ = &link;
  id_ = own;
}

// Commands that were unfinished when the simulator was switched must not be completed afterwards.
void SerialLine::drop_unfinished() {
  if (std::exchange(seen_switches_, device_->switches()) == device_->switches()) return;
  endpoint_.reset();
  device_parser_ = RhinoParser(Profile::kMark3);
}

void SerialLine::act_on_device(std::uint8_t byte, std::uint64_t offset, const Effects& effects) {
  Simulation& simulation = effects.simulation;
  std::vector<Parsed> parsed;
  device_parser_.feed(byte, offset, parsed);
  for (Parsed& item : parsed) {
    Exchange& exchange = effects.exchanges.emplace_back(std::move(item));
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
  leave({0, std::string(1, static_cast<char>(reply)), wire::FromDevice{inquiry, reply}}, 0);
}

}  // namespace xr3
