#include "cell/judge/run_observer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/grasp.hpp"
#include "core/kinematics.hpp"
#include "protocol/explain/event_report.hpp"

namespace xr3 {
namespace {

double square(Micrometres length) {
  return static_cast<double>(length) * static_cast<double>(length);
}

Micrometres distance_um(const PointUm& a, const PointUm& b) {
  return std::llround(std::sqrt(square(a.x - b.x) + square(a.y - b.y) + square(a.z - b.z)));
}

PointUm tip_of(const Cell& cell) {
  return tool_tip(cell.model(), positions(cell.model(), cell.state().motors));
}

/// Where a block is now; a held one where it would lie if it was released.
PointUm centroid_of(const Cell& cell, std::size_t block) {
  const State& state = cell.state();
  if (!state.held || state.held->block != block) return state.blocks[block].centroid_um;
  const Positions at = positions(cell.model(), state.motors);
  return as_released(cell.model(), state, *state.held, at).centroid_um;
}

}  // namespace

RunObserver::RunObserver(Cell& cell, const GoalList& goals)
    : cell_(cell), goals_(goals), last_(cell.state().motors), tip_(tip_of(cell)) {
  for (const Block& block : cell.state().blocks) start_.push_back({block.name, block.centroid_um});
  facts_.breaches.resize(goals.goals.size());
  for (std::size_t i = 0; i < goals.goals.size(); ++i) check(i, cell);
  cell.observe(*this, Cell::Ticks::kEach);
}

RunFacts RunObserver::facts() const {
  RunFacts facts = facts_;
  facts.bytes = cell_.counters().bytes_in;
  return facts;
}

// --- Events.

void RunObserver::happened(const Cell&, const CellOutput& output) {
  for (const CellEvent& event : output.events) note(event);
}

void RunObserver::note(const CellEvent& event) {
  if (const auto* problem = std::get_if<ProblemNote>(&event.note))
    return add_problem(event, problem->first_tick, static_cast<std::uint64_t>(problem->count));
  if (const auto* more = std::get_if<SuppressedNote>(&event.note))
    return void(facts_.problem_count += static_cast<std::uint64_t>(more->count));
  const auto* body = std::get_if<EventBody>(&event.note);
  if (body == nullptr) return;
  if (std::holds_alternative<Warning>(*body)) add_problem(event, event.tick, 1);
  if (const auto* grasped = std::get_if<Grasped>(body)) add_happening("grasped " + grasped->block);
  if (const auto* released = std::get_if<Released>(body))
    add_happening("released " + released->block);
  if (std::holds_alternative<Homed>(*body) && !facts_.soft_home_tick)
    facts_.soft_home_tick = event.tick;
  const auto* stalled = std::get_if<Stalled>(body);
  if (stalled == nullptr || facts_.stall) return;
  facts_.stall = stalled->why;
  facts_.stall_tick = event.tick;
}

void RunObserver::add_happening(std::string text) {
  if (facts_.happenings.size() < RunFacts::kMaxHappenings)
    facts_.happenings.push_back(std::move(text));
}

/// Problems with the same code are one.
void RunObserver::add_problem(const CellEvent& event, Tick first, std::uint64_t count) {
  facts_.problem_count += count;
  EventReport its = report(event, cell_.model());
  const auto same = std::find_if(facts_.problems.begin(), facts_.problems.end(),
                                 [&](const RunProblem& each) { return each.code == its.code; });
  if (same != facts_.problems.end()) return void(same->count += count);
  if (facts_.problems.size() < RunFacts::kMaxProblems)
    facts_.problems.push_back({first, std::string(its.code), std::move(its.message), count});
}

// --- Ticks.

void RunObserver::ticked(const Cell& cell) {
  if (!has_moved(cell.state())) return;
  facts_.last_count_tick = cell.state().tick;
  const PointUm before = std::exchange(tip_, tip_of(cell));
  facts_.tip_path_um += distance_um(before, tip_);
  for (std::size_t i = 0; i < goals_.goals.size(); ++i) check(i, cell);
}

bool RunObserver::has_moved(const State& state) {
  bool has_moved = false;
  for (std::size_t i = 0; i < last_.size(); ++i)
    has_moved = has_moved || last_[i].count != state.motors[i].count;
  if (has_moved) last_ = state.motors;
  return has_moved;
}

/// Notes the first tick at which a goal for the whole run is missed.
void RunObserver::check(std::size_t index, const Cell& cell) {
  std::optional<Breach>& first = facts_.breaches[index];
  if (first) return;
  const goal::Condition& body = goals_.goals[index].body;
  if (const auto* untouched = std::get_if<goal::Untouched>(&body)) first = breach(*untouched, cell);
  if (const auto* keep_out = std::get_if<goal::KeepOut>(&body)) first = breach(*keep_out, cell);
}

std::optional<Breach> RunObserver::breach(const goal::Untouched& goal, const Cell& cell) const {
  const auto& blocks = cell.state().blocks;
  for (std::size_t i = 0; i < blocks.size() && i < start_.size(); ++i) {
    const Start& start = start_[i];
    if (std::find(goal.names.begin(), goal.names.end(), start.name) == goal.names.end()) continue;
    const PointUm at = centroid_of(cell, i);
    if (blocks[i].name != start.name || distance_um(at, start.centroid) > goal.within_um)
      return Breach{cell.state().tick, start.name, at};
  }
  return std::nullopt;
}

std::optional<Breach> RunObserver::breach(const goal::KeepOut& goal, const Cell&) const {
  if (!goal.box.contains(tip_)) return std::nullopt;
  return Breach{cell_.state().tick, "", tip_};
}

}  // namespace xr3
