// The limit of simulated time: keeps the state to judge at that tick, however far an input advances
// the cell.
#pragma once

#include <optional>
#include <string>

#include "cell/judge/run_observer.hpp"

namespace xr3 {

/// Of `xr3 exec`, if nothing else is said.
constexpr Tick kUsualSimLimit = 600 * kTickHz;

/// The data by which a run is judged.
struct JudgedMoment {
  State state;
  RunFacts facts;
  std::string transcript;  ///< the digest; empty if there is none
};

JudgedMoment moment_of(const Cell& cell, const RunObserver& observer);

class SimLimit final : private CellObserver {
 public:
  /// Begins to observe. `limit`: a tick; 0 for none. The cell and the observer, which must have
  /// begun to observe before, must outlive it.
  SimLimit(Cell& cell, const RunObserver& observer, Tick limit);
  ~SimLimit() override { cell_.end_observation(*this); }

  /// The moment at which the limit was reached, and exceeded since; nullopt if it was not.
  const std::optional<JudgedMoment>& moment() const { return moment_; }
  /// The remaining ticks, but at most `most`.
  Tick left(Tick most) const;

 private:
  void ticked(const Cell& cell) override;

  Cell& cell_;
  const RunObserver& observer_;
  Tick limit_;
  std::optional<JudgedMoment> moment_;
};

}  // namespace xr3
