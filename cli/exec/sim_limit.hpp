// The limit of simulated time: what there is to judge at that tick, however far an input takes the
// cell.
#pragma once

#include <optional>
#include <string>

#include "cell/judge/run_observer.hpp"

namespace xr3 {

/// All by which a run is judged.
struct JudgedMoment {
  State state;
  RunFacts facts;
  std::string transcript;  ///< the digest; empty: there is none
};

JudgedMoment moment_of(const Cell& cell, const RunObserver& observer);

class SimLimit final : private CellWatcher {
 public:
  /// Begins to watch. `limit`: a tick; 0: none. The cell and the observer, which must have begun to
  /// watch before, must outlive it.
  SimLimit(Cell& cell, const RunObserver& observer, Tick limit);
  ~SimLimit() override { cell_.end_watch(*this); }

  /// The moment at which the limit was reached, and exceeded since; nullopt: it was not.
  const std::optional<JudgedMoment>& moment() const { return moment_; }
  /// The ticks that are left, but at most `most`.
  Tick left(Tick most) const;

 private:
  void event(const Cell&, const CellEvent&) override {}
  void after_tick(const Cell& cell) override;

  Cell& cell_;
  const RunObserver& observer_;
  Tick limit_;
  std::optional<JudgedMoment> moment_;
};

}  // namespace xr3
