// The faults in force, derived from those that are set and from the tick, and the effects of
// faults.
#pragma once

#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Events of effects of one fault in a simulated second. More effects only count.
inline constexpr std::uint32_t kMaxFaultNews = 64;

/// Recomputes the derived part of the faults, for a state from outside. Invariant: it changes no
/// state that was reached by step() and the functions of faults.hpp.
void refresh_faults(const Model& model, State& state);

/// Counts an effect and appends its event. `at`: see FaultNews.
void add_effect(const Model& model, State& state, FaultState& fault, char label, std::int64_t at,
                Events& events);

/// Whether a fault acts now, on an occasion with these two numbers (see chance.hpp). Not for faults
/// that last.
bool acts_on(const State& state, const FaultState& fault, std::uint64_t first,
             std::uint64_t second);

}  // namespace xr3
