// The inputs of a cell that concern the physical controller.
#include <cassert>
#include <cstdlib>
#include <utility>

#include "cell/cell.hpp"
#include "protocol/explain/diagnostic.hpp"

namespace xr3 {

void Cell::connect_device(std::string path, const SerialSettings& settings, bool is_mirrored) {
  assert(!device_ && lines_.empty() && !line_speed_);
  assert(clock_.mode() == ClockMode::kReal && clock_.rate() == Rate{});
  device_.emplace(std::move(path), settings, is_mirrored);
  if (is_mirrored) mirror_.emplace();
}

void Cell::emit_device(DeviceNews news, DeviceNote note) {
  note.news = news;
  note.path = device_->path();
  emit(std::nullopt, std::move(note));
}

/// The machine does not know that commands go to a device while it is disabled.
CellNote Cell::note_of(EventBody event) const {
  const auto* changed = std::get_if<EnabledChanged>(&event);
  if (!device_ || changed == nullptr) return event;
  return HandoverNote{changed->enabled, device_->path(), device_->is_open(),
                      device_->is_mirrored()};
}

void Cell::handle(const DeviceOpened&, WallNs) {
  assert(device_);
  device_->set_open(true, state().tick);
  emit_device(DeviceNews::kOpened);
}

void Cell::handle(const DeviceLost& lost, WallNs) {
  assert(device_);
  device_->set_open(false, state().tick);
  DeviceNote note;
  note.why = lost.why;
  emit_device(DeviceNews::kLost, std::move(note));
}

void Cell::handle(const DeviceIn& in, WallNs) {
  assert(device_);
  DeviceNote unasked;
  for (const char byte : in.bytes) {
    const auto reply = static_cast<std::uint8_t>(byte);
    const auto asked = device_->receive(state().tick);
    if (asked) compare_mirror(asked->command, reply);
    if (!asked) {
      unasked.raw.push(reply);
      ++unasked.count;
    } else if (asked->line) {
      deliver(*asked->line, reply, asked->command);
    }
  }
  if (unasked.count > 0) emit_device(DeviceNews::kUnasked, std::move(unasked));
}

void Cell::handle(const DeviceOut& out, WallNs) {
  assert(device_);
  device_->sent(out.count, state().tick);
}

void Cell::deliver(LineId id, std::uint8_t reply, const Command& inquiry) {
  SerialLine* line = open_line(id);
  assert(line != nullptr);
  const WirePlace out{epoch_, state().tick, id, line->output_end()};
  const std::size_t unsent = line->outbox().size();
  exchanges_.clear();
  line->deliver(reply, inquiry);
  record_out(out, *line, unsent);
  woken_.push_back(id);
}

void Cell::expire_inquiries() {
  while (const auto silent = device_->expire(state().tick)) {
    for (InputLog* log : logs_) log->expired(*this);
    if (!silent->line) continue;
    open_line(*silent->line)->note_warning();
    emit(*silent->line, silent_note(silent->command));
  }
}

call::Outcome Cell::carry_out(const call::StopDevice&, WallNs) {
  if (!device_)
    return call::Refused{"no_device", "no device is connected",
                         "start the server with --serial DEVICE"};
  if (!device_->is_open())
    return call::Refused{"no_device", "device " + device_->path() + " is not there",
                         "stop the arm by its own switch"};
  device_->stop(state().tick);
  if (mirror_ && device_->is_engaged()) {
    for (const char label : model().labels()) simulation_.execute(Stop{label});
  }
  emit_device(DeviceNews::kStopped);
  return call::Done{};
}

// --- The simulation beside the device.

void Cell::compare_mirror(const Command& inquiry, std::uint8_t reply) {
  const auto* error = std::get_if<QueryError>(&inquiry);
  if (!mirror_ || error == nullptr || reply < ' ') return;
  const int index = model().index_of(error->label);
  if (index < 0) return;
  const int simulated = std::abs(static_cast<int>(state().motor(index).error));
  const Mirror::JointReading reading{reply - ' ', simulated};
  if (!mirror_->differs(error->label, reading, state().tick)) return;
  DeviceNote note;
  note.why = std::string(1, error->label) + " has " + std::to_string(reading.device) +
             " counts to go there and " + std::to_string(reading.simulation) + " in the simulation";
  emit_device(DeviceNews::kMirrorDifference, std::move(note));
}

/// Whether the simulation stops where the arm goes on, for the first time. Jaws that close on a
/// block do so in both.
bool Cell::loses_mirror(const EventBody& event) {
  if (!mirror_ || !device_->is_engaged()) return false;
  const auto* blocked = std::get_if<MotorBlocked>(&event);
  const bool is_at_limit = blocked != nullptr && blocked->why == Blocked::kLimit;
  return (is_at_limit || std::holds_alternative<Stalled>(event)) && mirror_->lose();
}

call::Outcome Cell::carry_out(const call::AlignMirror&, WallNs) {
  if (!mirror_)
    return call::Refused{"no_device", "there is no mirrored device",
                         "start the server with --serial DEVICE --mirror"};
  simulation_.execute(SoftHome{});
  mirror_->align();
  emit_time_events();
  emit_device(DeviceNews::kMirrorAligned);
  return call::Done{};
}

}  // namespace xr3
