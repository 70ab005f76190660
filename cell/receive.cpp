#include "cell/receive.hpp"

#include <string>
#include <vector>

#include "cell/advance.hpp"
#include "cell/byte_time.hpp"
#include "cell/device.hpp"
#include "cell/events.hpp"
#include "cell/reply.hpp"

namespace xr3 {
namespace {

// A byte completes at most one inquiry, and that is the last exchange.
void execute(CellState& cell, SerialLine& line, const std::vector<Parsed>& items, Micros now,
             CellOutput& out) {
  const bool was_enabled = cell.state().enabled;
  std::string reply;
  for (const Parsed& item : items) {
    const auto* command = std::get_if<Command>(&item.what);
    if (command != nullptr && !pass_command(cell, line, *command, out)) return;
    line.endpoint().execute(item, cell.machine, reply, out.talk.exchanges);
  }
  if (cell.device && was_enabled && !cell.state().enabled) cell.device->engage(true);
  if (reply.empty()) return;
  const wire::Answered meaning = answer_of(out.talk.exchanges.back());
  answer(cell, line, reply, meaning, now, out);
}

void interpret(CellState& cell, SerialLine& line, const ReceivedByte& in, Micros now,
               CellOutput& out) {
  const std::vector<Parsed>& items = line.parse(in, cell.state().enabled);
  if (!items.empty()) execute(cell, line, items, now, out);  // most bytes complete nothing
}

/// A byte has passed the detector.
void take(CellState& cell, SerialLine& line, ReceivedByte in, Micros now, CellOutput& out) {
  if (line.is_network()) {
    const TelnetInput input = line.filter(in.byte);
    if (!input.data) return control(cell, line, input.control, now, out);
    in.byte = *input.data;
  }
  if (!line.delays(in, now)) act(cell, line, in, now, out);
}

void take_from_transport(CellState& cell, SerialLine& line, char byte, Micros now,
                         CellOutput& out) {
  const std::string passed = line.detect(static_cast<std::uint8_t>(byte));
  std::uint64_t offset = line.bytes_in() - passed.size();
  for (const char each : passed)
    take(cell, line, {static_cast<std::uint8_t>(each), offset++}, now, out);
}

/// Takes the first bytes of some that belong together. Returns their number.
std::size_t take_together(CellState& cell, SerialLine& line, std::string_view bytes,
                          CellOutput& out) {
  const bool was_paced = line.is_paced();
  const bool was_data = line.is_data(bytes.front());
  const std::uint64_t output = line.output_end();
  std::size_t taken = 0;
  while (taken < bytes.size() && accepts(cell, line, bytes[taken])) {
    if (line.is_paced() != was_paced || (was_paced && line.is_data(bytes[taken]) != was_data))
      break;
    take_from_transport(cell, line, bytes[taken++], micros_at(cell.tick()), out);
    const bool has_acted = !out.talk.exchanges.empty() || line.output_end() != output;
    if (has_acted && cell.is_moved_by_bytes()) break;
  }
  return taken;
}

}  // namespace

bool accepts(const CellState& cell, const SerialLine& line, char next) {
  const bool waits_for_device = cell.is_engaged() && !cell.device->accepts(line.id());
  return !waits_for_device && !line.is_not_a_robot_program() && line.accepts(next);
}

bool is_unread(const CellState& cell, LineId line) {
  return cell.in_past || (cell.byte_clock && line_before(cell, line));
}

std::size_t receive(CellState& cell, SerialLine& line, std::string_view bytes, CellOutput& out) {
  const std::uint64_t offset = line.bytes_in();
  const OutputMark before = mark_output(line);
  const std::optional<TelnetFilter> telnet = line.telnet();
  const bool waits = line.is_paced() && line.is_data(bytes.front());
  out.talk.clear();
  const std::size_t taken = take_together(cell, line, bytes, out);
  if (taken == 0) return 0;
  cell.counters.bytes_in += taken;
  emit_fault_events(cell, line, out);
  if (waits && !line.is_not_a_robot_program()) return taken;  // recorded when they act
  fill_in(out.add_record(), {cell.epoch, cell.tick(), line.id(), offset}, bytes.substr(0, taken),
          telnet, out.talk.exchanges, cell.machine, cell.device.has_value());
  record_output(cell, line, before, out);
  emit_exchanges(cell, line, out);
  if (!cell.is_moved_by_bytes()) return taken;
  schedule(cell, line);
  pass_delays(cell, out);
  return taken;
}

void act(CellState& cell, SerialLine& line, const ReceivedByte& in, Micros now, CellOutput& out) {
  if (!pass_character(cell, line, in.byte, out)) return;
  if (cell.device && act_on_device(cell, line, in, out)) return;
  LineFaults* faults = line.faults();
  if (faults != nullptr && faults->take_power_cycle(cell.state())) line.reset();
  if (faults == nullptr || faults->passes_input(cell.state()))
    return interpret(cell, line, in, now, out);
  for (const char each : faults->receive(in.byte, cell.machine))
    interpret(cell, line, {static_cast<std::uint8_t>(each), in.offset}, now, out);
  if (line.is_cut()) line.drop_input();
}

}  // namespace xr3
