// Judges a run by its goals: compares them with the state at the end and with the facts of the run.
// Independent of how the run was made.
//
// The flow through the folder: file.hpp reads a goals file into a GoalList (goal.hpp), in which
// each goal is a value of its kind, and consistency.cpp checks it, with a model also the names of
// blocks and joints. vary.hpp moves the blocks of the workcell at random before a run, reproducibly
// by a seed. While the run continues, an observer in cell/judge collects facts.hpp: what happened,
// which problems were reported, where a goal for the whole run was missed. At the end judge()
// compares each goal with the last state and these facts, and returns whether it is met, with two
// sentences for the student: expected and found (goal_text.hpp has their parts). credit.hpp then
// withholds points that a robot at rest would get without any program. The caller, `xr3 exec`, runs
// the program; the reports are in tools/report.
#pragma once

#include <string>
#include <vector>

#include "core/model.hpp"
#include "core/state.hpp"
#include "protocol/goals/facts.hpp"
#include "protocol/goals/goal.hpp"

namespace xr3 {

/// The judgement of one goal. The texts are parts of sentences for a student.
struct GoalResult {
  bool is_met = false;
  int points = 1;          ///< points of the goal
  std::string kind;        ///< as in the goals file
  std::string expected;    ///< such as `block red at x 400, y 0 mm, within 5 mm`
  std::string found;       ///< such as `it is at x 262, y 0, z 20 mm, 138 mm away`
  std::string hint;        ///< the author's hint, or a general one; empty if the goal is met
  bool is_counted = true;  ///< false: the goal is met, and gives no points; see credit.hpp

  /// The points that the run gets for the goal.
  int earned() const { return is_met && is_counted ? points : 0; }
};

/// One result for each goal, in order. Precondition: `facts` was collected for these goals, and
/// `end` is a state of the model.
std::vector<GoalResult> judge(const GoalList& list, const Model& model, const State& end,
                              const RunFacts& facts);

/// The points that the run gets, and the points of all goals.
int points_of(const std::vector<GoalResult>& results);
int max_points_of(const std::vector<GoalResult>& results);

}  // namespace xr3
