#include "cell/device.hpp"

#include <cassert>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "cell/events.hpp"
#include "cell/reply.hpp"
#include "protocol/explain/diagnostic.hpp"

namespace xr3 {
namespace {

// A port of 7 data bits would make another character of it.
constexpr std::uint8_t kFirstByteOf8Bits = 0x80;

/// The simulation carries out a command, too. The reply is discarded: that of the device counts,
/// and the commands that only the simulator has are not answered by a physical controller.
void imitate(CellState& cell, const Command& command, Exchange& exchange) {
  cell.machine.execute(command);
  exchange.events = cell.machine.take_events();
}

void execute(CellState& cell, const SerialLine& line, Exchange& exchange, std::uint8_t byte) {
  DeviceLink& device = *cell.device;
  auto& what = exchange.parsed.what;
  const Command* command = std::get_if<Command>(&what);
  if (command != nullptr && std::holds_alternative<ToggleSimulator>(*command)) {
    imitate(cell, *command, exchange);
    device.engage(false);
  } else if (command != nullptr && for_device(*command)) {
    exchange.is_for_device = true;
    device.add(line.id(), *command, cell.tick());
    if (device.is_mirrored()) imitate(cell, *command, exchange);
  } else if (command != nullptr && device.is_mirrored()) {
    imitate(cell, *command, exchange);
  } else if (command != nullptr || byte >= kFirstByteOf8Bits) {
    what = Problem{ProblemCode::kNotForDevice, Subject::kNone};
  }
}

/// Sends a reply of the device to the line that asked.
void deliver(CellState& cell, SerialLine& line, std::uint8_t reply, const Command& inquiry,
             CellOutput& out) {
  const char byte = static_cast<char>(reply);
  const OutputMark before = mark_output(line);
  out.talk.clear();
  pass_on(cell, line, {&byte, 1}, wire::FromDevice{inquiry, reply}, 0, out);
  record_output(cell, line, before, out);
  out.woken.push_back(line.id());
}

void compare_mirror(CellState& cell, const Command& inquiry, std::uint8_t reply, CellOutput& out) {
  const auto* error = std::get_if<QueryError>(&inquiry);
  if (!cell.mirror || error == nullptr || reply < ' ') return;
  const int index = cell.model().index_of(error->label);
  if (index < 0) return;
  const int simulated = std::abs(static_cast<int>(cell.state().motor(index).error));
  const Mirror::JointReading reading{reply - ' ', simulated};
  if (!cell.mirror->differs(error->label, reading, cell.tick())) return;
  DeviceNote note;
  note.why = std::string(1, error->label) + " has " + std::to_string(reading.device) +
             " counts to go there and " + std::to_string(reading.simulation) + " in the simulation";
  emit_device(cell, DeviceNews::kMirrorDifference, std::move(note), out);
}

}  // namespace

// Commands that were unfinished when the simulator was switched must not be completed afterwards.
bool act_on_device(CellState& cell, SerialLine& line, const ReceivedByte& in, CellOutput& out) {
  assert(cell.device);
  line.drop_unfinished(cell.device->switches());
  if (!cell.device->is_engaged()) return false;
  std::vector<Parsed> parsed;
  line.device_parser().feed(in.byte, in.offset, parsed);
  for (Parsed& item : parsed)
    execute(cell, line, out.talk.exchanges.emplace_back(std::move(item)), in.byte);
  return true;
}

void open_device(CellState& cell, CellOutput& out) {
  assert(cell.device);
  cell.device->set_open(true, cell.tick());
  emit_device(cell, DeviceNews::kOpened, {}, out);
}

void lose_device(CellState& cell, const DeviceLost& lost, CellOutput& out) {
  assert(cell.device);
  cell.device->set_open(false, cell.tick());
  DeviceNote note;
  note.why = lost.why;
  emit_device(cell, DeviceNews::kLost, std::move(note), out);
}

void receive_from_device(CellState& cell, const DeviceIn& in, CellOutput& out) {
  assert(cell.device);
  DeviceNote unasked;
  for (const char byte : in.bytes) {
    const auto reply = static_cast<std::uint8_t>(byte);
    const auto asked = cell.device->receive(cell.tick());
    if (asked) compare_mirror(cell, asked->command, reply, out);
    if (!asked) {
      unasked.raw.push(reply);
      ++unasked.count;
    } else if (asked->line) {
      deliver(cell, *cell.find_line(*asked->line), reply, asked->command, out);
    }
  }
  if (unasked.count > 0) emit_device(cell, DeviceNews::kUnasked, std::move(unasked), out);
}

void expire_inquiries(CellState& cell, CellOutput& out) {
  while (const auto silent = cell.device->expire(cell.tick())) {
    out.silences.push_back(cell.tick());
    if (!silent->line) continue;
    cell.find_line(*silent->line)->note_warning();
    emit(cell, *silent->line, silent_note(silent->command), out);
  }
}

void emit_device(CellState& cell, DeviceNews news, DeviceNote note, CellOutput& out) {
  note.news = news;
  note.path = cell.device->path();
  emit(cell, std::nullopt, std::move(note), out);
}

CellNote note_of(const CellState& cell, EventBody event) {
  const auto* changed = std::get_if<EnabledChanged>(&event);
  if (!cell.device || changed == nullptr) return event;
  return HandoverNote{changed->enabled, cell.device->path(), cell.device->is_open(),
                      cell.device->is_mirrored()};
}

bool loses_mirror(CellState& cell, const EventBody& event) {
  if (!cell.mirror || !cell.device->is_engaged()) return false;
  const auto* blocked = std::get_if<MotorBlocked>(&event);
  const bool is_at_limit = blocked != nullptr && blocked->why == Blocked::kLimit;
  return (is_at_limit || std::holds_alternative<Stalled>(event)) && cell.mirror->lose();
}

}  // namespace xr3
