#include "cell/apply.hpp"

#include <utility>

#include "cell/advance.hpp"
#include "cell/byte_time.hpp"
#include "cell/calls/calls.hpp"
#include "cell/device.hpp"
#include "cell/epoch.hpp"
#include "cell/events.hpp"
#include "cell/receive.hpp"
#include "cell/reply.hpp"
#include "protocol/explain/diagnostic.hpp"

namespace xr3 {
namespace {

struct Applier {
  CellState& cell;
  WallNs now;
  const IsEnough& is_enough;
  CellOutput& out;

  // --- Lines. Inputs of a line that is not open have no effect.

  Applied operator()(const LineOpened& opened) const {
    const LineId id = ++cell.last_line;
    SerialLine& line = cell.lines
                           .try_emplace(id, id, cell.model().profile(), opened.kind, opened.peer,
                                        cell.tick(), opened.guard)
                           .first->second;
    ++cell.counters.lines_total;
    emit(cell, id, LineOpenedNote{opened.kind, opened.peer}, out);
    if (opened.kind != LineKind::kMonitor) {
      if (!cell.device) line.expose(cell.state());
      if (cell.line_speed) line.set_speed(*cell.line_speed);
    }
    if (!cell.state().enabled && !cell.is_engaged()) emit(cell, id, disabled_note(), out);
    if (const auto before = line_before(cell, id)) emit(cell, id, LineTurnNote{*before}, out);
    return {.line = id};
  }

  Applied operator()(const LineSettings& reported) const {
    SerialLine* line = cell.find_line(reported.line);
    if (line == nullptr) return {};
    note_settings(cell, *line, reported.settings);
    const bool is_news = line->set_settings(reported.settings, reported.is_cooked);
    schedule(cell, *line);
    if (is_news) emit(cell, reported.line, cooked_note(), out);
    return {};
  }

  Applied operator()(const BytesIn& in) const {
    SerialLine* line = cell.find_line(in.line);
    if (line == nullptr || is_unread(cell, in.line)) return {};
    cell.last_input_tick = cell.tick();
    if (line->bytes_in() == 0 && line->is_network()) line->examine(in.bytes);
    std::size_t taken = 0;
    while (taken < in.bytes.size()) {
      const std::size_t count = receive(cell, *line, in.bytes.substr(taken, kMaxShownIn), out);
      taken += count;
      out.hand_over_if_large();
      if (count == 0 || line->is_not_a_robot_program()) break;
      if (taken < in.bytes.size() && is_enough && is_enough()) break;
    }
    schedule(cell, *line);
    if (cell.warnings.has_lines())
      emit_all(cell, in.line, cell.warnings.finish(in.line, cell.tick()), out);
    return {.bytes_taken = taken};
  }

  Applied operator()(const BytesOut& sent) const {
    SerialLine* line = cell.find_line(sent.line);
    if (line == nullptr) return {};
    line->sent(sent.count, micros_at(cell.tick()));
    schedule(cell, *line);
    return {};
  }

  Applied operator()(const InputEnded& ended) const {
    SerialLine* line = cell.find_line(ended.line);
    if (line == nullptr) return {};
    const OutputMark before = mark_output(*line);
    out.talk.clear();
    line->end_input();
    resume(cell, *line, micros_at(cell.tick()), out);
    const bool waits_for_ever = line->holds_replies() && !line->next_reply(cell.state());
    if (waits_for_ever) line->faults()->discard();  // no end of the fault is known
    record_output(cell, *line, before, out);
    schedule(cell, *line);
    return {};
  }

  Applied operator()(const LineClosed& closed) const {
    SerialLine* line = cell.find_line(closed.line);
    if (line == nullptr) return {};
    cell.agenda.forget(closed.line);
    out.talk.clear();
    record_acted(cell, *line, out);
    record_departed(cell, *line, out);
    emit_all(cell, closed.line, cell.warnings.forget(closed.line), out);
    ++cell.counters.of(closed.reason);
    emit(cell, closed.line, LineClosedNote{closed.reason, line->bytes_in(), line->bytes_out()},
         out);
    if (cell.device) cell.device->forget(closed.line);
    remember(closed.line, line->bytes_in());
    const bool was_current = current_line(cell) == closed.line;
    cell.lines.erase(closed.line);
    note_end(cell, closed.line, closed.reason);
    if (was_current || cell.lines.empty()) end_turn(cell, closed.reason, out);
    return {};
  }

  Applied operator()(const LineSilent& silent) const {
    const bool moves_time = cell.is_moved_by_bytes() && current_line(cell) == silent.line;
    if (!moves_time || cell.in_past || cell.machine.is_at_rest()) return {};
    mark(cell, TranscriptMark::kSilence);
    rest(cell, out);
    return {};
  }

  // --- The physical controller.

  Applied operator()(const DeviceOpened&) const {
    open_device(cell, out);
    return {};
  }
  Applied operator()(const DeviceLost& lost) const {
    lose_device(cell, lost, out);
    return {};
  }
  Applied operator()(const DeviceIn& in) const {
    receive_from_device(cell, in, out);
    return {};
  }
  Applied operator()(const DeviceOut& sent) const {
    cell.device->sent(sent.count, cell.tick());
    return {};
  }

  // --- Others.

  Applied operator()(const Rewind& rewind) const {
    take_back(cell, rewind, now, out);
    return {};
  }

  Applied operator()(const RecordingFailed& failed) const {
    ++cell.counters.recordings_failed;
    emit(cell, std::nullopt, RecordingNote{failed.path, failed.why}, out);
    return {};
  }

  Applied operator()(const call::Call& call) const {
    if (cell.in_past && !call::traits_of(call).works_in_past) return {.outcome = in_the_past()};
    Applied applied{.outcome = carry_out(cell, call, now, out)};
    emit_time_events(cell, out);
    if (std::holds_alternative<call::Done>(applied.outcome)) note_call(call);
    return applied;
  }

 private:
  void remember(LineId line, std::uint64_t bytes_in) const {
    cell.closed_bytes_in[line] = bytes_in;
    if (cell.closed_bytes_in.size() > kRememberedLines)
      cell.closed_bytes_in.erase(cell.closed_bytes_in.begin());
  }

  /// A call has changed the cell.
  void note_call(const call::Call& call) const {
    if (!call::traits_of(call).keeps_transcript) mark(cell, TranscriptMark::kNotBytesAlone);
    if (cell.is_moved_by_bytes() && cell.lines.empty()) rest(cell, out);
  }
};

}  // namespace

Applied apply(CellState& cell, const Input& input, WallNs now, const IsEnough& is_enough,
              CellOutput& out) {
  Applied applied = std::visit(Applier{cell, now, is_enough, out}, input);
  if (!std::holds_alternative<BytesOut>(input)) pass_delays(cell, out);
  return applied;
}

call::Outcome carry_out(CellState& cell, const call::Call& call, WallNs now, CellOutput& out) {
  return std::visit([&](const auto& each) { return carry_out(cell, each, now, out); }, call);
}

}  // namespace xr3
