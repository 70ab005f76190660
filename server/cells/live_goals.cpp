#include "server/cells/live_goals.hpp"

#include <utility>

#include "cell/judge/passive.hpp"
#include "core/home.hpp"
#include "protocol/goals/credit.hpp"

namespace xr3 {

LiveGoals::LiveGoals(Cell& cell, std::shared_ptr<const LiveExercise> exercise)
    : cell_(cell), exercise_(std::move(exercise)), epoch_(cell.epoch()) {
  observer_.emplace(cell_, exercise_->goals);
}

void LiveGoals::update() {
  if (epoch_ != cell_.epoch()) restart();
}

void LiveGoals::restart() {
  epoch_ = cell_.epoch();
  observer_.reset();
  observer_.emplace(cell_, exercise_->goals);
}

void LiveGoals::describe(monitor::CellSummary& summary) const {
  const GoalList& goals = exercise_->goals;
  const RunFacts facts = observer_->facts();
  std::vector<GoalResult> results = judge(goals, cell_.model(), cell_.state(), facts);
  withhold(results, goals, exercise_->passive, RunOutcome::kFinished, facts);
  summary.goals.emplace();
  for (const GoalResult& each : results) summary.goals->push_back(each.is_met && each.is_counted);
  summary.points = {points_of(results), max_points_of(results)};
}

LiveExercise live_exercise(std::string title, GoalList goals, const ModelPtr& model,
                           const std::optional<FaultPlan>& faults) {
  RunFacts nothing;
  nothing.breaches.resize(goals.goals.size());
  std::vector<std::string> sentences;
  for (GoalResult& each : judge(goals, *model, initial_state(*model), nothing))
    sentences.push_back(std::move(each.expected));
  std::vector<bool> passive = passive_goals(goals, model, faults);
  return {std::move(title), std::move(goals), std::move(sentences), std::move(passive)};
}

}  // namespace xr3
