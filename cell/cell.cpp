#include "cell/cell.hpp"

#include <algorithm>
#include <cassert>
#include <nlohmann/json.hpp>
#include <utility>

#include "cell/events.hpp"
#include "cell/failure.hpp"
#include "protocol/monitor/event.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3 {

Cell::Cell(std::string name, ModelPtr model, SimClock clock, monitor::ByteBudget* budget)
    : state_{{Simulation(std::move(model)), clock}, {std::move(name)}},
      output_([this](CellOutput& output) { take(output); }),
      events_(
          kMaxEvents,
          [this](const CellEvent& event, std::int64_t seq) {
            return monitor::channel_message(monitor::Channel::kEvent,
                                            {this->name(), event.epoch, seq, event.tick},
                                            monitor::text_of(event_json(event, this->model())));
          },
          budget, kEventHeap),
      wires_(
          kMaxWires,
          [this](const WireRecord& record, std::int64_t seq) {
            return monitor::channel_message(monitor::Channel::kLine,
                                            {this->name(), record.epoch, seq, record.tick},
                                            monitor::text_of(wire_json(record, this->model())));
          },
          budget, kWireHeap) {
  if (clock.running_mode() == ClockMode::kBytes) state_.transcript.emplace();
}

// --- Settings.

void Cell::connect_device(std::string path, const SerialSettings& settings, bool is_mirrored) {
  assert(!state_.device && state_.lines.empty() && !state_.line_speed);
  assert(clock().mode() == ClockMode::kReal && clock().rate() == Rate{});
  state_.device.emplace(std::move(path), settings, is_mirrored);
  if (is_mirrored) state_.mirror.emplace();
}

void Cell::set_faults(FaultPlan plan) {
  assert(state_.lines.empty() && plan.faults.size() <= kMaxFaults);
  state_.initial_faults = std::move(plan);
  state_.machine.install_faults(state_.initial_faults);
  emit_time_events(state_, output_);
  output_.hand_over();
}

void Cell::set_byte_clock(const ByteClockSettings& settings,
                          const std::optional<LineSpeed>& speed) {
  assert(state_.lines.empty() && !state_.line_speed);
  assert(clock().running_mode() == ClockMode::kBytes);
  state_.byte_clock.emplace(settings, speed);
  if (settings.has_concurrent_lines) mark(state_, TranscriptMark::kArrivalOrder);
}

void Cell::set_line_speed(const LineSpeed& speed) {
  assert(state_.lines.empty() && !state_.device);
  state_.line_speed = speed;
}

// With a byte clock a new transcript begins, which says so.
void Cell::continue_from(Rewindable end, FaultPlan initial_faults, std::optional<LineSpeed> speed,
                         std::string origin) {
  assert(state_.lines.empty() && !state_.device && end.lines.empty() && !origin.empty());
  static_cast<Rewindable&>(state_) = std::move(end);
  state_.initial_faults = std::move(initial_faults);
  state_.line_speed = speed;
  state_.origin = std::move(origin);
  if (clock().running_mode() == ClockMode::kBytes) state_.transcript.emplace();
  mark(state_, TranscriptMark::kNotBytesAlone);
  ++revision_;
}

// --- Inputs and time.

Applied Cell::apply(const Input& input, WallNs now, const IsEnough& is_enough) {
  return fatal_if_throws("the cell", [&]() -> Applied {
    assert(!std::holds_alternative<BytesOut>(input));
    if (is_frozen_) return {};
    advance_clock(now);
    ++revision_;
    return act(input, now, is_enough);
  });
}

void Cell::sent(const BytesOut& out) {
  fatal_if_throws("the cell", [&] {
    if (find_line(out.line) == nullptr) return;
    act(out, 0, {});
  });
}

Applied Cell::act(const Input& input, WallNs now, const IsEnough& is_enough) {
  for (const Observation& each : observers_) each.observer->before(*this, input);
  Applied applied = xr3::apply(state_, input, now, is_enough, output_);
  output_.hand_over();
  for (const Observation& each : observers_) each.observer->after(*this, input, applied);
  return applied;
}

void Cell::catch_up(WallNs now) {
  fatal_if_throws("the cell", [&] { advance_clock(now); });
}

void Cell::advance_clock(WallNs now) {
  if (is_frozen_ || state_.is_replayed) return;
  if (state_.is_moved_by_bytes()) {
    pass_delays(state_, output_);
    return output_.hand_over();
  }
  // Simulated time stops at the maximum integer of the protocol, after some 285,000 years.
  const Tick target = std::min(clock().at(now), monitor::kMaxInteger);
  pass_time(target, kMaxDueBytes);
  if (state_.tick() < target) state_.clock.set_tick(state_.tick(), now);
}

void Cell::pass_time(Tick target, std::size_t max_bytes) {
  const Tick before = state_.tick();
  const std::size_t bytes = advance(state_, target, output_, max_bytes);
  if (state_.tick() != before || bytes > 0) {
    state_.counters.ticks += static_cast<std::uint64_t>(state_.tick() - before);
    ++revision_;
    emit_time_events(state_, output_);
  }
  output_.hand_over();
}

void Cell::begin_replay() {
  state_.is_replayed = true;
  state_.clock.set_tick(state_.tick(), 0);
}

void Cell::replay_to(Tick tick) {
  assert(state_.is_replayed);
  fatal_if_throws("the cell", [&] {
    pass_time(std::min(tick, monitor::kMaxInteger), kEveryByte);
    state_.clock.set_tick(state_.tick(), 0);
  });
}

void Cell::end_replay(WallNs now) {
  state_.is_replayed = false;
  state_.clock.set_tick(state_.tick(), now);
}

const Rewindable& Cell::checkpoint() const {
  assert(!state_.device);
  return state_;
}

// The revision is incremented, not restored: frames that were encoded for it would be reused.
void Cell::restore(const Rewindable& from) {
  assert(!state_.device);
  static_cast<Rewindable&>(state_) = from;
  state_.clock.set_tick(state_.tick(), 0);
  state_.warnings = {};
  state_.is_replayed = true;
  state_.contests = {};
  woken_.clear();
  ++revision_;
}

// --- Observers.

void Cell::observe(CellObserver& observer, Ticks ticks) {
  observers_.push_back({&observer, ticks});
  if (ticks == Ticks::kEach && !output_.on_tick) output_.on_tick = [this] { end_tick(); };
}

void Cell::end_observation(const CellObserver& observer) {
  std::erase_if(observers_, [&](const Observation& each) { return each.observer == &observer; });
  const bool has_ticks = std::any_of(observers_.begin(), observers_.end(),
                                     [](const auto& each) { return each.ticks == Ticks::kEach; });
  if (!has_ticks) output_.on_tick = nullptr;
}

void Cell::end_tick() {
  for (const Observation& each : observers_)
    if (each.ticks == Ticks::kEach) each.observer->ticked(*this);
}

/// Shows what has happened to the observers, and then moves it into the rings.
void Cell::take(CellOutput& output) {
  ++revision_;
  for (const Observation& each : observers_) each.observer->happened(*this, output);
  woken_.insert(woken_.end(), output.woken.begin(), output.woken.end());
  for (CellEvent& event : output.events) events_.push() = std::move(event);
  for (WireRecord& record : output.records()) std::swap(wires_.push(), record);
}

void Cell::report_opened() {
  emit(state_, std::nullopt, CellOpenedNote{name()}, output_);
  output_.hand_over();
}

void Cell::report_closed() {
  emit(state_, std::nullopt, CellClosedNote{name()}, output_);
  output_.hand_over();
}

void Cell::report_continued(const std::string& path, const std::string& why) {
  emit(state_, std::nullopt, ContinuedNote{path, why}, output_);
  output_.hand_over();
}

// --- Queries.

Snapshot Cell::snapshot() const {
  std::optional<DeviceStatus> status;
  if (const DeviceLink* its = device())
    status = {its->path(), its->is_open(), its->is_engaged(), its->bytes_out(), its->bytes_in()};
  return {epoch(), clock().mode(),    clock().rate(), model_rev(),
          state(), std::move(status), is_in_past(),   is_frozen()};
}

bool Cell::has_news_to_come() const {
  const bool is_asking = state_.device && state_.device->deadline();
  return clock().mode() == ClockMode::kReal &&
         (!is_at_rest() || state_.warnings.has_pending() || is_asking);
}

std::optional<std::uint64_t> Cell::bytes_in(LineId line) const {
  if (const SerialLine* open = find_line(line)) return open->bytes_in();
  const auto closed = state_.closed_bytes_in.find(line);
  if (closed == state_.closed_bytes_in.end()) return std::nullopt;
  return closed->second;
}

std::vector<LineId> Cell::take_woken_lines() {
  std::vector<LineId> all = std::exchange(woken_, {});
  if (state_.device) {
    const std::vector<LineId> accepting = state_.device->take_woken();
    all.insert(all.end(), accepting.begin(), accepting.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::int64_t Cell::copy_events(std::int64_t seq, std::int64_t count,
                               std::vector<CellEvent>& to) const {
  seq = std::max(seq, events_.first());
  for (const std::int64_t end = std::min(seq + count, events_.next()); seq < end; ++seq)
    to.push_back(events_.value_at(seq));
  return seq;
}

}  // namespace xr3
