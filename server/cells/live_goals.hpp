// The goals of an exercise at a cell that is in use: which of them are met now. Each epoch is
// judged by itself, so that a reset begins anew.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cell/judge/run_observer.hpp"
#include "core/faults/fault.hpp"
#include "protocol/goals/goal.hpp"
#include "protocol/monitor/overview.hpp"

namespace xr3 {

/// An exercise whose goals are shown while programs work on it.
struct LiveExercise {
  std::string title;  ///< empty if there are only goals
  GoalList goals;
  std::vector<std::string> sentences;  ///< one for each goal, such as `block red at x 400 mm`
  std::vector<bool> passive;           ///< passive_goals() of the robot
};

class LiveGoals {
 public:
  /// Begins to observe. The cell, which has what the goals name, must outlive it.
  LiveGoals(Cell& cell, std::shared_ptr<const LiveExercise> exercise);

  /// To be called after each input of the cell: begins anew in a new epoch.
  void update();
  /// Begins anew, since the cell has another state.
  void restart();
  /// Fills in the goals that are met now, with their points.
  void describe(monitor::CellSummary& summary) const;
  const LiveExercise& exercise() const { return *exercise_; }

 private:
  Cell& cell_;
  std::shared_ptr<const LiveExercise> exercise_;
  std::optional<RunObserver> observer_;
  Epoch epoch_;
};

/// The exercise with these goals, which are for this model.
LiveExercise live_exercise(std::string title, GoalList goals, const ModelPtr& model,
                           const std::optional<FaultPlan>& faults);

}  // namespace xr3
