#include "cell/cell.hpp"

#include <algorithm>
#include <utility>

#include "cell/failure.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/event_report.hpp"
#include "protocol/monitor/event.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3 {

Cell::Cell(std::string name, ModelPtr model, SimClock clock, CellEventSink sink,
           monitor::ByteBudget* budget)
    : name_(std::move(name)),
      simulation_(std::move(model)),
      clock_(clock),
      events_(
          kMaxEvents,
          [this](const CellEvent& event, std::int64_t seq) {
            return monitor::channel_message(monitor::Channel::kEvent,
                                            {name_, event.epoch, seq, event.tick},
                                            monitor::text_of(event_json(event, this->model())));
          },
          budget, kEventHeap),
      wires_(
          kMaxWires,
          [this](const WireRecord& record, std::int64_t seq) {
            return monitor::channel_message(monitor::Channel::kLine,
                                            {name_, record.epoch, seq, record.tick},
                                            monitor::text_of(wire_json(record, this->model())));
          },
          budget, kWireHeap),
      sink_(std::move(sink)) {
  if (clock_.running_mode() == ClockMode::kBytes) transcript_.emplace();
}

Applied Cell::apply(const Input& input, WallNs now) {
  return fatal_if_throws("the cell", [&] { return take_in(input, now); });
}

void Cell::catch_up(WallNs now) {
  fatal_if_throws("the cell", [&] { advance(now); });
}

Applied Cell::take_in(const Input& input, WallNs now) {
  if (is_frozen_) return {};
  advance(now);
  ++revision_;
  for (InputLog* log : logs_) log->begin(*this, input);
  Applied applied = std::visit(
      [&](const auto& each) -> Applied {
        if constexpr (!std::is_void_v<decltype(handle(each, now))>) return handle(each, now);
        handle(each, now);
        return {};
      },
      input);
  pass_delays();
  for (InputLog* log : logs_) log->end(*this, input, applied);
  return applied;
}

void Cell::advance(WallNs now) {
  if (is_frozen_ || is_replayed_) return;
  if (is_moved_by_bytes()) return pass_delays();
  // Simulated time stops at the maximum integer of the protocol, after some 285,000 years.
  const Tick target = std::min(clock_.at(now), monitor::kMaxInteger);
  pass_time(target, kMaxDueBytes);
  if (state().tick < target) clock_.set_tick(state().tick, now);
  for (InputLog* log : logs_) log->after_advance(*this);
}

void Cell::pass_time(Tick target, std::size_t max_bytes) {
  const Tick before = state().tick;
  const std::size_t bytes = advance_to(target, max_bytes);
  if (state().tick == before && bytes == 0) return;
  counters_.ticks += static_cast<std::uint64_t>(state().tick - before);
  ++revision_;
  emit_time_events();
}

void Cell::begin_replay() {
  is_replayed_ = true;
  clock_.set_tick(state().tick, 0);
}

void Cell::replay_to(Tick tick) {
  assert(is_replayed_);
  fatal_if_throws("the cell", [&] {
    pass_time(std::min(tick, monitor::kMaxInteger), kEveryByte);
    clock_.set_tick(state().tick, 0);
  });
}

void Cell::end_replay(WallNs now) {
  is_replayed_ = false;
  clock_.set_tick(state().tick, now);
}

// Emits the machine's events, and the reports of suppressed warnings that are due.
void Cell::emit_time_events() {
  if (!simulation_.events().empty()) emit_machine_events(std::nullopt, simulation_.take_events());
  for (auto& [line, note] : warnings_.take_pending(state().tick)) emit(line, std::move(note));
  if (device_) expire_inquiries();
}

Snapshot Cell::snapshot() const {
  std::optional<DeviceStatus> device;
  if (device_)
    device = {device_->path(), device_->is_open(), device_->is_engaged(), device_->bytes_out(),
              device_->bytes_in()};
  return {epoch_,  clock_.mode(),     clock_.rate(), model_rev_,
          state(), std::move(device), is_in_past_};
}

const SerialLine* Cell::find_line(LineId line) const {
  const auto found = lines_.find(line);
  return found == lines_.end() ? nullptr : &found->second;
}

SerialLine* Cell::open_line(LineId line) { return const_cast<SerialLine*>(find_line(line)); }

std::optional<std::uint64_t> Cell::bytes_in(LineId line) const {
  if (const auto open = lines_.find(line); open != lines_.end()) return open->second.bytes_in();
  const auto closed = closed_bytes_in_.find(line);
  if (closed == closed_bytes_in_.end()) return std::nullopt;
  return closed->second;
}

// --- Lines.

std::vector<LineId> Cell::take_woken_lines() {
  std::vector<LineId> all = std::exchange(woken_, {});
  if (device_) {
    const std::vector<LineId> accepting = device_->take_woken();
    all.insert(all.end(), accepting.begin(), accepting.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Applied Cell::handle(const LineOpened& opened, WallNs) {
  const LineId id = ++last_line_;
  lines_.try_emplace(id, model().profile(), opened.kind, opened.peer, state().tick, opened.guard);
  ++counters_.lines_total;
  emit(id, LineOpenedNote{opened.kind, opened.peer});
  const bool is_for_device = device_ && device_->is_engaged();
  if (device_) lines_.at(id).connect(*device_, id);
  if (!device_ && opened.kind != LineKind::kMonitor) lines_.at(id).expose(id, state());
  if (line_speed_ && opened.kind != LineKind::kMonitor) lines_.at(id).set_speed(*line_speed_);
  if (transcript_) lines_.at(id).listen(*this, id);
  if (!state().enabled && !is_for_device) emit(id, disabled_note());
  if (const std::optional<LineId> before = line_before(id)) emit(id, LineTurnNote{*before});
  return {.line = id};
}

void Cell::handle(const LineSettings& reported, WallNs) {
  SerialLine* line = open_line(reported.line);
  if (line == nullptr) return;
  note_settings(*line, reported.settings);
  const bool is_news = line->set_settings(reported.settings, reported.is_cooked);
  schedule(reported.line, *line);
  if (is_news) emit(reported.line, cooked_note());
}

Applied Cell::handle(const BytesIn& in, WallNs) {
  SerialLine* line = open_line(in.line);
  if (line == nullptr) return {};
  if (is_unread(in.line)) return {};
  last_input_tick_ = state().tick;
  if (line->bytes_in() == 0 && line->is_network()) line->examine(in.bytes);
  std::size_t taken = 0;
  while (taken < in.bytes.size()) {
    const std::string_view piece = in.bytes.substr(taken, kMaxShownIn);
    const std::size_t count = is_moved_by_bytes() ? receive_timed(in.line, *line, piece)
                                                  : receive_piece(in.line, *line, piece);
    taken += count;
    if (count == 0 || line->is_not_a_robot_program()) break;
    if (taken < in.bytes.size() && in.is_enough && in.is_enough()) break;
  }
  schedule(in.line, *line);
  if (warnings_.has_lines()) emit_all(in.line, warnings_.finish(in.line, state().tick));
  return {.bytes_taken = taken};
}

/// Receives the bytes of one record, and records them with their effects and replies. Returns the
/// number of bytes taken.
std::size_t Cell::receive_piece(LineId id, SerialLine& line, std::string_view bytes) {
  const WirePlace in{epoch_, state().tick, id, line.bytes_in()};
  const WirePlace out{epoch_, state().tick, id, line.output_end()};
  const std::optional<TelnetFilter> telnet = line.telnet();
  const std::size_t unsent = line.outbox().size();
  const bool waits = line.is_paced() && line.is_data(bytes.front());
  exchanges_.clear();
  const std::size_t taken = line.receive(bytes, simulation_, exchanges_);
  if (taken == 0) return 0;
  counters_.bytes_in += taken;
  if (line.has_fault_events()) emit_fault_events(id, line);
  if (waits && !line.is_not_a_robot_program()) return taken;  // recorded when they act
  fill_in(wires_.push(), in, bytes.substr(0, taken), telnet, exchanges_, simulation_,
          device_.has_value());
  record_out(out, line, unsent);
  emit_exchanges(id, line);
  return taken;
}

/// Records the bytes that the line has added to its outbox after the first `unsent` ones.
void Cell::record_out(const WirePlace& out, const SerialLine& line, std::size_t unsent) {
  const std::string_view added = line.outbox().substr(unsent);
  if (added.empty()) return;
  counters_.bytes_out += added.size();
  fill_out(wires_.push(), out, added, exchanges_, line.released());
  for (InputLog* log : logs_) log->output(*this, out.line, added);
}

void Cell::sent(const BytesOut& out) {
  fatal_if_throws("the cell", [&] {
    SerialLine* line = open_line(out.line);
    if (line == nullptr) return;
    for (InputLog* log : logs_) log->sent(*this, out);
    line->sent(out.count, micros_at(state().tick));
    schedule(out.line, *line);
  });
}

void Cell::handle(const InputEnded& ended, WallNs) {
  SerialLine* line = open_line(ended.line);
  if (line == nullptr) return;
  const WirePlace out{epoch_, state().tick, ended.line, line->output_end()};
  const std::size_t unsent = line->outbox().size();
  exchanges_.clear();
  line->end_input(micros_at(state().tick));
  if (!line->next_reply(state())) line->discard_held_back();  // no end of the fault is known
  record_out(out, *line, unsent);
  schedule(ended.line, *line);
}

void Cell::handle(const LineClosed& closed, WallNs) {
  SerialLine* line = open_line(closed.line);
  if (line == nullptr) return;
  agenda_.forget(closed.line);
  exchanges_.clear();
  record_acted(closed.line, *line);
  record_departed(closed.line, *line);
  emit_all(closed.line, warnings_.forget(closed.line));
  ++counters_.of(closed.reason);
  emit(closed.line, LineClosedNote{closed.reason, line->bytes_in(), line->bytes_out()});
  if (device_) device_->forget(closed.line);
  closed_bytes_in_[closed.line] = line->bytes_in();
  if (closed_bytes_in_.size() > kRememberedLines) closed_bytes_in_.erase(closed_bytes_in_.begin());
  const bool was_current = current_line() == closed.line;
  lines_.erase(closed.line);
  note_end(closed.line, closed.reason);
  if (was_current || lines_.empty()) end_turn(closed.reason);
}

void Cell::handle(const RecordingFailed& failed, WallNs) {
  ++counters_.recordings_failed;
  emit(std::nullopt, RecordingNote{failed.path, failed.why});
}

Applied Cell::handle(const call::Call& call, WallNs now) {
  if (is_in_past_ && !call::traits_of(call).works_in_past) return {.outcome = in_the_past()};
  Applied applied{.outcome =
                      std::visit([&](const auto& each) { return carry_out(each, now); }, call)};
  emit_time_events();
  if (std::holds_alternative<call::Done>(applied.outcome)) note_call(call);
  return applied;
}

// --- Events.

void Cell::emit(std::optional<LineId> line, CellNote note) {
  emit_at(state().tick, line, std::move(note));
}

std::int64_t Cell::copy_events(std::int64_t seq, std::int64_t count,
                               std::vector<CellEvent>& to) const {
  seq = std::max(seq, events_.first());
  for (const std::int64_t end = std::min(seq + count, events_.next()); seq < end; ++seq)
    to.push_back(events_.value_at(seq));
  return seq;
}

void Cell::emit_at(Tick tick, std::optional<LineId> line, CellNote note) {
  CellEvent& event = events_.push();
  event = {epoch_, tick, line, std::move(note)};
  if (sink_) sink_(event, model());
  for (CellWatcher* watcher : watchers_) watcher->event(*this, event);
  if (const auto contested = contests_.handle(event)) emit_at(tick, line, *contested);
}

void Cell::emit_machine_events(std::optional<LineId> line, Events events) {
  for (Event& event : events) {
    if (const Warning* warning = std::get_if<Warning>(&event.body))
      ++counters_.warnings[code_of(warning->code)];
    const bool is_lost = loses_mirror(event.body);
    note_fault(event.body);
    emit_at(event.tick, line, note_of(std::move(event.body)));
    if (is_lost) emit_device(DeviceNews::kMirrorLost);
  }
}

void Cell::emit_exchanges(LineId id, SerialLine& line, std::size_t first) {
  for (std::size_t i = first; i < exchanges_.size(); ++i) {
    Exchange& exchange = exchanges_[i];
    line.note(exchange.parsed.raw);
    if (const Problem* problem = std::get_if<Problem>(&exchange.parsed.what)) {
      line.note_warning();
      warn(id, exchange.parsed, code_of(problem->code),
           [&] { return describe(exchange.parsed, *problem); });
    } else {
      ++counters_.of(std::get<Command>(exchange.parsed.what));
    }
    for (Event& event : exchange.events) {
      if (const Warning* warning = std::get_if<Warning>(&event.body)) {
        line.note_warning();
        warn(id, exchange.parsed, code_of(warning->code),
             [&] { return report(event.body, model()).message; });
        continue;
      }
      emit_all(id, warnings_.finish(id, event.tick));
      const bool is_lost = loses_mirror(event.body);
      emit(id, note_of(std::move(event.body)));
      if (is_lost) emit_device(DeviceNews::kMirrorLost);
    }
  }
}

// Calls `message` only for the first problem of a run: invalid bytes can arrive by the megabyte.
void Cell::warn(LineId line, const Parsed& parsed, std::string_view code,
                const std::function<std::string()>& message) {
  const Tick tick = state().tick;
  ++counters_.warnings[code];
  if (warnings_.extends_run(line, tick, code)) return;
  emit_all(line, warnings_.add(line, tick, {code, message(), parsed.from, parsed.raw, 1}));
}

void Cell::emit_all(LineId line, std::vector<CellNote> notes) {
  for (CellNote& note : notes) emit(line, std::move(note));
}

}  // namespace xr3
