#include "cell/events.hpp"

#include <utility>

#include "cell/device.hpp"
#include "cell/faults.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/event_report.hpp"

namespace xr3 {
namespace {

void emit_at(CellState& cell, Tick tick, std::optional<LineId> line, CellNote note,
             CellOutput& out) {
  out.events.push_back({cell.epoch, tick, line, std::move(note)});
  const auto contested = cell.contests.handle(out.events.back());
  if (contested) out.events.push_back({cell.epoch, tick, line, *contested});
}

/// An event of the machine that a command or time has caused.
void emit_machine_event(CellState& cell, std::optional<LineId> line, Event event, CellOutput& out) {
  const bool is_lost = loses_mirror(cell, event.body);
  emit_at(cell, event.tick, line, note_of(cell, std::move(event.body)), out);
  if (is_lost) emit_device(cell, DeviceNews::kMirrorLost, {}, out);
}

}  // namespace

void emit(CellState& cell, std::optional<LineId> line, CellNote note, CellOutput& out) {
  emit_at(cell, cell.tick(), line, std::move(note), out);
}

void emit_all(CellState& cell, LineId line, std::vector<CellNote> notes, CellOutput& out) {
  for (CellNote& note : notes) emit(cell, line, std::move(note), out);
}

void emit_machine_events(CellState& cell, Events events, CellOutput& out) {
  for (Event& event : events) {
    if (const Warning* warning = std::get_if<Warning>(&event.body))
      ++cell.counters.warnings[code_of(warning->code)];
    cut_lines(cell, event.body, out);
    emit_machine_event(cell, std::nullopt, std::move(event), out);
  }
}

void emit_time_events(CellState& cell, CellOutput& out) {
  if (!cell.machine.events().empty()) emit_machine_events(cell, cell.machine.take_events(), out);
  for (auto& [line, note] : cell.warnings.take_pending(cell.tick()))
    emit(cell, line, std::move(note), out);
  if (cell.device) expire_inquiries(cell, out);
}

void warn(CellState& cell, SerialLine& line, const Parsed& parsed, std::string_view code,
          const std::function<std::string()>& message, CellOutput& out) {
  const Tick tick = cell.tick();
  line.note_warning();
  ++cell.counters.warnings[code];
  if (cell.warnings.extends_run(line.id(), tick, code)) return;
  ProblemNote note{code, message(), parsed.from, parsed.raw, 1};
  emit_all(cell, line.id(), cell.warnings.add(line.id(), tick, std::move(note)), out);
}

void emit_exchanges(CellState& cell, SerialLine& line, CellOutput& out) {
  const LineId id = line.id();
  for (; out.talk.reported < out.talk.exchanges.size(); ++out.talk.reported) {
    Exchange& exchange = out.talk.exchanges[out.talk.reported];
    line.note(exchange.parsed.raw);
    if (const Problem* problem = std::get_if<Problem>(&exchange.parsed.what)) {
      warn(
          cell, line, exchange.parsed, code_of(problem->code),
          [&] { return describe(exchange.parsed, *problem); }, out);
    } else {
      ++cell.counters.of(std::get<Command>(exchange.parsed.what));
    }
    for (Event& event : exchange.events) {
      if (const Warning* warning = std::get_if<Warning>(&event.body)) {
        warn(
            cell, line, exchange.parsed, code_of(warning->code),
            [&] { return report(event.body, cell.model()).message; }, out);
        continue;
      }
      emit_all(cell, id, cell.warnings.finish(id, event.tick), out);
      event.tick = cell.tick();
      emit_machine_event(cell, id, std::move(event), out);
    }
  }
}

void emit_fault_events(CellState& cell, SerialLine& line, CellOutput& out) {
  LineFaults* faults = line.faults();
  if (faults == nullptr || !faults->has_events()) return;
  for (Event& event : faults->take_events()) {
    emit_all(cell, line.id(), cell.warnings.finish(line.id(), event.tick), out);
    emit_at(cell, event.tick, line.id(), std::move(event.body), out);
  }
}

OutputMark mark_output(const SerialLine& line) { return {line.output_end(), line.outbox().size()}; }

void record_output(CellState& cell, const SerialLine& line, const OutputMark& before,
                   CellOutput& out) {
  const std::string_view added = line.outbox().substr(before.unsent);
  if (added.empty()) return;
  cell.counters.bytes_out += added.size();
  fill_out(out.add_record(), {cell.epoch, cell.tick(), line.id(), before.end}, added,
           out.talk.replies);
  out.add_bytes(cell.tick(), line.id(), added);
}

}  // namespace xr3
