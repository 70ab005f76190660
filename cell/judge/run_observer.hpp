// Collects the facts of a run that a judge needs, while a cell goes on. Its memory is bounded for
// any length of the run.
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "protocol/goals/facts.hpp"
#include "protocol/goals/goal.hpp"

namespace xr3 {

class RunObserver final : private CellObserver {
 public:
  /// Begins to watch. The cell and the goals must outlive the observer.
  RunObserver(Cell& cell, const GoalList& goals);
  ~RunObserver() override { cell_.end_observation(*this); }

  /// The facts until now.
  RunFacts facts() const;

 private:
  struct Start {
    std::string name;
    PointUm centroid;
  };

  void happened(const Cell& cell, const CellOutput& output) override;
  void ticked(const Cell& cell) override;
  void note(const CellEvent& event);
  void add_problem(const CellEvent& event, Tick first, std::uint64_t count);
  void add_happening(std::string text);
  bool has_moved(const State& state);
  void check(std::size_t index, const Cell& cell);
  std::optional<Breach> breach(const goal::Untouched& goal, const Cell& cell) const;
  std::optional<Breach> breach(const goal::KeepOut& goal, const Cell& cell) const;

  Cell& cell_;
  const GoalList& goals_;
  RunFacts facts_;
  std::vector<Start> start_;  ///< of the blocks
  Motors last_;
  PointUm tip_;
};

}  // namespace xr3
