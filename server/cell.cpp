#include "server/cell.hpp"

#include <algorithm>
#include <utility>

#include "protocol/diagnostic.hpp"

namespace xr3 {
namespace {

call::Refused clock_running(std::string_view call) {
  return {"clock_running", std::string(call) + " needs standing time; the clock is real",
          "call pause first, or start with --clock manual"};
}

}  // namespace

Cell::Cell(std::string name, ModelPtr model, SimClock clock, CellEventSink sink)
    : name_(std::move(name)),
      simulation_(std::move(model)),
      clock_(clock),
      sink_(std::move(sink)) {}

Applied Cell::apply(const Input& input, WallNs now) {
  catch_up(now);
  return std::visit([&](const auto& each) { return take(each, now); }, input);
}

void Cell::catch_up(WallNs now) {
  simulation_.advance_to(clock_.at(now));
  if (!simulation_.events().empty()) tell_machine(std::nullopt, simulation_.take_events());
}

Line* Cell::find_line(LineId line) {
  const auto found = lines_.find(line);
  return found == lines_.end() ? nullptr : &found->second;
}

std::optional<std::uint64_t> Cell::bytes_in(LineId line) const {
  if (const auto open = lines_.find(line); open != lines_.end()) return open->second.bytes_in();
  const auto closed = closed_bytes_in_.find(line);
  if (closed == closed_bytes_in_.end()) return std::nullopt;
  return closed->second;
}

// --- Lines.

Applied Cell::take(const LineOpened& opened, WallNs) {
  lines_.try_emplace(opened.line, model().profile(), opened.peer, state().tick);
  tell(opened.line, LineOpenedNote{opened.peer});
  if (!state().enabled) {
    const Problem problem{ProblemCode::kDisabled, Subject::kNone};
    tell(opened.line, ProblemNote{code_of(problem.code), describe(Parsed{}, problem), 0, {}, 1});
  }
  return {};
}

Applied Cell::take(const BytesIn& in, WallNs) {
  Line* line = find_line(in.line);
  if (line == nullptr) return {};
  exchanges_.clear();
  const std::size_t taken = line->receive(in.bytes, simulation_, exchanges_);
  tell_exchanges(in.line);
  return {taken, {}};
}

Applied Cell::take(const LineClosed& closed, WallNs) {
  const Line* line = find_line(closed.line);
  if (line == nullptr) return {};
  tell(closed.line, LineClosedNote{closed.reason, line->bytes_in(), line->bytes_out()});
  closed_bytes_in_[closed.line] = line->bytes_in();
  if (closed_bytes_in_.size() > kRememberedLines) closed_bytes_in_.erase(closed_bytes_in_.begin());
  lines_.erase(closed.line);
  warnings_.forget(closed.line);
  return {};
}

// --- Calls.

Applied Cell::take(const call::Call& call, WallNs now) {
  Applied applied;
  applied.outcome = std::visit([&](const auto& each) { return carry_out(each, now); }, call);
  if (!simulation_.events().empty()) tell_machine(std::nullopt, simulation_.take_events());
  return applied;
}

call::Outcome Cell::carry_out(const call::Pause&, WallNs now) {
  clock_.pause(now);
  tell(std::nullopt, ClockNote{"pause"});
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::Resume&, WallNs now) {
  clock_.resume(now);
  tell(std::nullopt, ClockNote{"resume"});
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::SetRate& rate, WallNs now) {
  clock_.set_rate(rate.rate, now);
  tell(std::nullopt, ClockNote{"rate"});
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::Step& step, WallNs now) {
  if (clock_.mode() != ClockMode::kManual) return clock_running("step");
  simulation_.advance_to(state().tick + step.ticks);
  clock_.set_tick(state().tick, now);
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::RunUntil& run, WallNs now) {
  if (clock_.mode() != ClockMode::kManual) return clock_running("run_until");
  const Tick start = state().tick;
  const Tick limit = start + run.max_ticks;
  if (run.tick) {
    simulation_.advance_to(std::min(limit, *run.tick));
  } else {
    simulation_.run_to_rest(limit);
  }
  clock_.set_tick(state().tick, now);
  const bool reached = run.tick ? state().tick >= *run.tick : is_at_rest();
  return call::Done{reached, state().tick - start};
}

call::Outcome Cell::carry_out(const call::Reset&, WallNs now) {
  const EpochNote note{epoch_, state().tick};
  simulation_.reset();
  clock_.set_tick(0, now);
  ++epoch_;
  for (auto& [id, line] : lines_) line.reset();
  tell(std::nullopt, note);
  return call::Done{};
}

call::Outcome Cell::carry_out(const call::Home&, WallNs) {
  simulation_.execute(SoftHome{});
  return call::Done{};
}

// --- What is told.

void Cell::tell(std::optional<LineId> line, CellNote note) {
  if (sink_) sink_({epoch_, state().tick, line, std::move(note)});
}

void Cell::tell_machine(std::optional<LineId> line, Events events) {
  if (!sink_) return;
  for (Event& event : events) sink_({epoch_, event.tick, line, std::move(event.body)});
}

void Cell::tell_exchanges(LineId line) {
  for (Exchange& exchange : exchanges_) {
    if (const Problem* problem = std::get_if<Problem>(&exchange.parsed.what)) {
      warn(line, exchange.parsed, code_of(problem->code),
           [&] { return describe(exchange.parsed, *problem); });
    }
    for (Event& event : exchange.events) {
      if (const Warning* warning = std::get_if<Warning>(&event.body)) {
        warn(line, exchange.parsed, code_of(warning->code),
             [&] { return describe(event.body, model()); });
        continue;
      }
      tell_all(line, warnings_.finish(line, event.tick));
      tell(line, std::move(event.body));
    }
  }
  tell_all(line, warnings_.finish(line, state().tick));
}

// The sentence is made only where it will be told: garbage comes by the megabyte.
void Cell::warn(LineId line, const Parsed& parsed, std::string_view code,
                const std::function<std::string()>& message) {
  const Tick tick = state().tick;
  if (warnings_.extends_run(line, tick, code)) return;
  tell_all(line, warnings_.take(line, tick, {code, message(), parsed.from, parsed.raw, 1}));
}

void Cell::tell_all(LineId line, std::vector<CellNote> notes) {
  for (CellNote& note : notes) tell(line, std::move(note));
}

}  // namespace xr3
